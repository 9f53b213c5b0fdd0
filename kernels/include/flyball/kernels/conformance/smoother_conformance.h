// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of smoother.h as checks: curves are sampled, and held against their limits, their
/// continuity and every cell of a dense map.

#include "flyball/kernels/conformance/dense_map.h"
#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/smoother.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

class SmootherConformance : public KernelConformance<Smoother> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      check_open_space();
      check_corridor();
      check_refusals();
      check_work();
      check_memory();
    });
  }

 private:
  static constexpr int samples = 1000;
  static constexpr double slack = 1.02;  // Of limits, for peaks between the samples.

  static DenseMap open_space() { return {{{0, 0, 0}, {1, 1, 1}}, 0.15}; }

  static SmoothRequest along(std::vector<Vec3> points_W) {
    SmoothRequest request;
    request.waypoints_W = std::move(points_W);
    request.max_speed_m_s = 6.0;
    request.max_acceleration_m_s2 = 3.0;
    request.body = {0.355, 0.13};
    return request;
  }

  static SmoothRequest zigzag(std::uint64_t seed, int corners) {
    RandomStream random{seed, "smoother_conformance"};
    std::vector<Vec3> points_W{{0, 0, 2}};
    for (int i = 0; i <= corners; ++i) {
      points_W.push_back(points_W.back() + Vec3{random.uniform(1.0, 8.0), random.uniform(-6.0, 6.0),
                                                random.uniform(-0.3, 0.3)});
    }
    return along(points_W);
  }

  /// Two corridors of 1.2 m that meet at a right angle, with walls around them.
  static DenseMap corridors() {
    DenseMap map{{{-1.05, -1.05, 0}, {9, 9, 3}}, 0.15, CellState::occupied};
    map.fill({{-0.6, -0.6, 0}, {8.4, 0.6, 3}}, CellState::free);
    map.fill({{7.2, -0.6, 0}, {8.4, 8.4, 3}}, CellState::free);
    return map;
  }
  static SmoothRequest around_the_corner() {
    return along({{0, 0, 1.5}, {7.8, 0, 1.5}, {7.8, 8, 1.5}});
  }

  void check_curve(const Trajectory& curve, const SmoothRequest& request) {
    const double end_s = curve.duration_s();
    if (curve.pieces.empty() || !std::isfinite(end_s) || end_s <= 0.0) {
      require(false, "makes a curve without a duration");
      return;
    }
    require((curve.derivative(0, 0.0) - request.waypoints_W.front()).norm() < 1e-6 &&
                (curve.derivative(0, end_s) - request.waypoints_W.back()).norm() < 1e-6,
            "does not lead from the first way-point to the last");
    require(curve.derivative(1, end_s).norm() < 1e-3, "does not stop at its end");
    double fastest_m_s = 0.0;
    double hardest_m_s2 = 0.0;
    for (int i = 0; i <= samples; ++i) {
      fastest_m_s = std::max(fastest_m_s, curve.derivative(1, end_s * i / samples).norm());
      hardest_m_s2 = std::max(hardest_m_s2, curve.derivative(2, end_s * i / samples).norm());
    }
    require(fastest_m_s <= slack * request.max_speed_m_s, "is faster than it may be");
    require(hardest_m_s2 <= slack * request.max_acceleration_m_s2, "accelerates more than it may");
    for (std::size_t i = 0; i + 1 < curve.pieces.size(); ++i) {
      const PolynomialPiece& before = curve.pieces[i];
      for (int n = 0; n <= 1; ++n) {
        const Vec3 jump =
            curve.pieces[i + 1].derivative(n, 0.0) - before.derivative(n, before.duration_s);
        require(jump.norm() < 1e-5, "jumps between two pieces in place or velocity");
      }
    }
  }

  static bool hits(const Trajectory& curve, const DenseMap& map, const Cylinder& body) {
    const double end_s = curve.duration_s();
    for (int i = 0; i < samples; ++i) {
      if (map.segment_hits(curve.derivative(0, end_s * i / samples),
                           curve.derivative(0, end_s * (i + 1) / samples), body)) {
        return true;
      }
    }
    return false;
  }

  void check_open_space() {
    std::vector<SmoothRequest> requests{along({{0, 0, 2}, {30, 0, 2}}),
                                        along({{0, 0, 2}, {0.2, 0, 2}})};
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      requests.push_back(zigzag(seed, 1 + static_cast<int>(seed)));
    }
    requests.back().start_velocity_W = {1.0, 0.5, 0.0};
    for (const SmoothRequest& request : requests) {
      const auto smooth = made()->smooth(request, open_space());
      require(smooth.ok(), "finds no curve where nothing is in the way");
      if (smooth) {
        check_curve(smooth->trajectory, request);
      }
    }
    check_direction(requests.back());
  }

  void check_direction(const SmoothRequest& request) {
    const auto smooth = made()->smooth(request, open_space());
    if (!smooth || smooth->trajectory.pieces.empty()) {
      return;  // Said above.
    }
    const Vec3 start = smooth->trajectory.derivative(1, 0.0);
    // It may begin at rest, but not into another direction.
    require(
        start.norm() < 1e-6 || start.normalized().dot(request.start_velocity_W.normalized()) > 0.99,
        "does not begin in the direction of the start velocity");
  }

  void check_corridor() {
    const SmoothRequest request = around_the_corner();
    const DenseMap map = corridors();
    const auto smooth = made()->smooth(request, map);
    require(smooth.ok(), "finds no curve along a polygon that is free");
    if (smooth) {
      check_curve(smooth->trajectory, request);
      require(!hits(smooth->trajectory, map, request.body), "hits an obstacle");
    }
    const auto colliding = made()->smooth(along({{0, 0, 1.5}, {0, 8, 1.5}}), map);
    require(!colliding && colliding.error().code == ErrorCode::failed,
            "does not refuse a polygon that collides");
  }

  void check_refusals() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<SmoothRequest> bad(6, along({{0, 0, 2}, {5, 0, 2}}));
    bad[0].waypoints_W.resize(1);
    bad[1].waypoints_W.clear();
    bad[2].waypoints_W[1].y() = nan;
    bad[3].max_speed_m_s = 0.0;
    bad[4].max_acceleration_m_s2 = nan;
    bad[5].start_velocity_W.x() = nan;
    for (const SmoothRequest& request : bad) {
      const auto smooth = made()->smooth(request, open_space());
      require(!smooth && smooth.error().code == ErrorCode::invalid_input &&
                  !smooth.error().message.empty(),
              "accepts too few way-points, numbers that are not finite, or limits of zero");
    }
  }

  void check_work() {
    const auto few = made()->smooth(zigzag(40, 1), open_space());
    const auto many = made()->smooth(zigzag(40, 12), open_space());
    if (few && many) {
      require(few->work.count("pieces") > 0.0, "counts no pieces");
      require_work(many->work, few->work);
    }
  }

  static bool is_equal(const Trajectory& one, const Trajectory& other) {
    return std::equal(one.pieces.begin(), one.pieces.end(), other.pieces.begin(),
                      other.pieces.end(), [](const PolynomialPiece& a, const PolynomialPiece& b) {
                        return a.c == b.c && a.duration_s == b.duration_s;
                      });
  }

  void check_memory() {
    const auto used = made();
    for (const std::uint64_t seed : {50U, 51U, 50U}) {
      const SmoothRequest request = zigzag(seed, 3);
      const auto fresh = made()->smooth(request, open_space());
      const auto again = used->smooth(request, open_space());
      require(
          fresh.ok() == again.ok() && (!fresh || is_equal(fresh->trajectory, again->trajectory)),
          "answers differently after other requests");
    }
  }
};

}  // namespace flyball
