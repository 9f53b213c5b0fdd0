// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of explorer.h as checks, in a hall of which a part is known.

#include "flyball/kernels/conformance/dense_map.h"
#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/explorer.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace flyball {

class ExplorerConformance : public KernelConformance<Explorer> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({"explore.iterations", "explore.threads"}, [this] {
      check_steps();
      check_nothing_left();
      check_taken();
      check_work();
      check_refusals();
      check_missions();
    });
  }

 private:
  /// Known from its end at x = 0 up to so far.
  static DenseMap hall(double known_to_m) {
    DenseMap map{{{0, 0, 0}, {12, 6, 3}}, 0.15, CellState::unknown};
    map.fill({{0, 0, 0}, {known_to_m, 6, 3}}, CellState::free);
    map.fill({{2.4, 4.5, 0}, {2.7, 4.8, 3}}, CellState::occupied);
    return map;
  }
  static ExploreRequest request(std::uint64_t seed) {
    ExploreRequest request;
    request.from = {{1.0, 3.0, 1.2}, 0.0};
    request.volume_W = {{0, 0, 0}, {12, 6, 3}};
    request.bounds_W = {{0.5, 0.5, 0.5}, {11.5, 5.5, 2.1}};
    request.body = {0.355, 0.155};
    request.seed = seed;
    return request;
  }

  void check_step(const ExploreStep& step, const ExploreRequest& asked, const DenseMap& map) {
    if (!step.next) {
      require(false, "finds nothing to see where half of the volume is unknown");
      return;
    }
    const Vec3 edge = step.next->p_W - asked.from.p_W;
    require(step.next->p_W.allFinite() && std::isfinite(step.next->yaw_rad) &&
                asked.bounds_W.contains(step.next->p_W),
            "goes out of the bounds");
    require(std::isfinite(step.gain_m3) && step.gain_m3 > 0.0, "goes where it gains nothing");
    require(map.body_state(step.next->p_W, asked.body) == CellState::free,
            "stands where the body has no known-free room");
    if (step.is_far) {
      return;
    }
    require(edge.norm() <= asked.settings.extension_m + 1e-6, "takes a longer edge than it may");
    require(std::abs(edge.z()) <= std::tan(asked.max_slope_rad) * edge.head<2>().norm() + 1e-6,
            "takes a steeper edge than it may");
    for (double share = 0.05; share < 1.0; share += 0.05) {
      require(map.body_state(asked.from.p_W + share * edge, asked.body) == CellState::free,
              "takes an edge through space that is not known to be free");
    }
  }

  void check_steps() {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const DenseMap map = hall(3.0 + 1.5 * static_cast<double>(seed));
      const ExploreRequest asked = request(seed);
      check_step(made()->explore(asked, map), asked, map);
    }
  }

  void check_nothing_left() {
    const ExploreStep step = made()->explore(request(7), hall(12.0));
    require(!step.next && step.gain_m3 == 0.0, "finds something to see where all is known");
  }

  /// What a view did not show although it was had stays hidden.
  void check_taken() {
    const DenseMap map = hall(5.0);
    ExploreRequest asked = request(8);
    const ExploreStep first = made()->explore(asked, map);
    if (first.next) {
      asked.taken = {*first.next};
      const ExploreStep second = made()->explore(asked, map);
      require(!second.next || second.next->p_W != first.next->p_W ||
                  second.next->yaw_rad != first.next->yaw_rad,
              "takes a view again that was had");
    }
  }

  void check_work() {
    ExploreRequest asked = request(9);
    asked.settings.iterations = asked.settings.most_iterations = 5;
    const Work few = made()->explore(asked, hall(5.0)).work;
    asked.settings.iterations = asked.settings.most_iterations = 40;
    const Work many = made()->explore(asked, hall(5.0)).work;
    require(few.count("iterations") > 0.0, "counts no iterations");
    require_work(many, few);
  }

  void check_refusals() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<ExploreRequest> bad(2, request(10));
    bad[0].from.p_W.x() = nan;
    bad[1].volume_W.max.z() = nan;
    for (const ExploreRequest& asked : bad) {
      require(!made()->explore(asked, hall(5.0)).next,
              "goes somewhere from a place, or in a volume, that is not finite");
    }
  }

  /// An explorer remembers within a mission, so whole missions are compared.
  void check_missions() {
    const auto flown = [this](int threads) {
      const auto explorer = made();
      std::vector<double> trace;
      ExploreRequest asked = request(11);
      asked.settings.threads = threads;
      for (int i = 0; i < 3; ++i) {
        const ExploreStep step = explorer->explore(asked, hall(4.0 + i));
        trace.push_back(step.gain_m3);
        if (step.next) {
          asked.from = *step.next;
          trace.insert(trace.end(), {step.next->p_W.x(), step.next->p_W.y(), step.next->p_W.z(),
                                     step.next->yaw_rad});
        }
      }
      return trace;
    };
    const std::vector<double> first = flown(1);
    require(flown(1) == first, "explores differently in a second mission");
    require(flown(3) == first, "explores differently with several threads");
  }
};

}  // namespace flyball
