// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of coverage_planner.h as checks: every place of the area must lie within half a
/// lane of the path.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/coverage_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace flyball {

class CoveragePlannerConformance : public KernelConformance<CoveragePlanner> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      for (const int lanes : {1, 2, 3, 8}) {
        check_coverage(lanes);
      }
      check_refusals();
      check_work();
      check_memory();
    });
  }

 private:
  static CoverageRequest field(int lanes) {
    CoverageRequest request;
    request.corner_W = {10.0, 20.0, 15.0};
    request.length_m = 100.0;
    request.width_m = 60.0;
    request.lanes = lanes;
    request.start_W = {0.0, 0.0, 15.0};
    request.end_W = {0.0, 5.0, 15.0};
    return request;
  }

  static double distance_m(const std::vector<Vec3>& points_W, const Vec3& p_W) {
    double least_m = (points_W.front() - p_W).norm();
    for (std::size_t i = 0; i + 1 < points_W.size(); ++i) {
      const Vec3 edge = points_W[i + 1] - points_W[i];
      const double along = (p_W - points_W[i]).dot(edge) / std::max(edge.squaredNorm(), 1e-12);
      least_m = std::min(least_m, (points_W[i] + std::clamp(along, 0.0, 1.0) * edge - p_W).norm());
    }
    return least_m;
  }

  void check_coverage(int lanes) {
    const CoverageRequest request = field(lanes);
    const auto path = made()->cover(request);
    if (!path || path->waypoints_W.size() < 2) {
      require(false, "finds no path over an ordinary field");
      return;
    }
    const auto& points_W = path->waypoints_W;
    require(points_W.front() == request.start_W && points_W.back() == request.end_W,
            "does not lead from the start to the end");
    require(std::all_of(points_W.begin(), points_W.end(),
                        [](const Vec3& p_W) { return std::abs(p_W.z() - 15.0) < 1e-9; }),
            "leaves the height of flight");
    double worst_m = 0.0;
    for (double x_m = 10.0; x_m <= 110.0; x_m += 5.0) {
      for (double y_m = 20.0; y_m <= 80.0; y_m += 2.5) {
        worst_m = std::max(worst_m, distance_m(points_W, {x_m, y_m, 15.0}));
      }
    }
    require(worst_m <= 0.5 * request.width_m / lanes + 1e-6, "leaves a part of the area out");
    require(std::abs(path->out_m - (points_W[1] - points_W[0]).norm()) < 1e-6 &&
                std::abs(path->back_m - (points_W.back() - points_W[points_W.size() - 2]).norm()) <
                    1e-6,
            "is wrong about how far the area is from start and end");
  }

  void check_refusals() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<CoverageRequest> bad(5, field(3));
    bad[0].lanes = 0;
    bad[1].width_m = 0.0;
    bad[2].length_m = -1.0;
    bad[3].end_W.x() = nan;
    bad[4].width_m = nan;
    for (const CoverageRequest& request : bad) {
      const auto path = made()->cover(request);
      require(
          !path && path.error().code == ErrorCode::invalid_input && !path.error().message.empty(),
          "accepts an area without extent, no lane, or a place that is not finite");
    }
  }

  void check_work() {
    const auto few = made()->cover(field(2));
    const auto many = made()->cover(field(9));
    if (few && many) {
      require(few->work.count("waypoints") > 0.0, "counts no waypoints");
      require_work(many->work, few->work);
    }
  }

  void check_memory() {
    const auto used = made();
    for (const int lanes : {4, 2, 4}) {
      const auto fresh = made()->cover(field(lanes));
      const auto again = used->cover(field(lanes));
      require(fresh.ok() == again.ok() && (!fresh || (fresh->waypoints_W == again->waypoints_W &&
                                                      is_same(fresh->work, again->work))),
              "answers differently after other questions");
    }
  }
};

}  // namespace flyball
