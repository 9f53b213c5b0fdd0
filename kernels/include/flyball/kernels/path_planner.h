// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Shortest path: from a start to a goal region through what the map knows and what it does not.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace flyball {

struct PlanRequest {
  Vec3 start_W{Vec3::Zero()};
  Vec3 goal_W{Vec3::Zero()};
  Aabb bounds_W{};            ///< The body's centre stays inside.
  Cylinder body{};            ///< With its tracking tube.
  int max_iterations{10000};  ///< Planner iterations, over all attempts.
  /// Longer paths are not wanted. When finite, the search keeps to the places where such paths can
  /// be and looks at narrow passages first.
  double shorter_than_m{std::numeric_limits<double>::infinity()};
  double max_slope_rad{0.35};  ///< Of each straight piece; about 20 degrees.
  /// Here the vehicle flies slowly in any case, so that room beside a path is not worth a longer
  /// one. A planner may ignore it.
  std::vector<Aabb> slow_W{};
  /// A way that the vehicle has flown, from near the start to near the goal; empty: none. Where it
  /// is free on the map, nothing need be searched for, unless a shorter path is wanted. A planner
  /// may ignore it.
  std::vector<Vec3> flown_W{};
  std::uint64_t seed{};  ///< Of this one plan.
};

/// Of the polygon through these points.
[[nodiscard]] inline double length_m(const std::vector<Vec3>& points_W) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < points_W.size(); ++i) {
    sum_m += (points_W[i] - points_W[i - 1]).norm();
  }
  return sum_m;
}

struct Plan {
  std::vector<Vec3> waypoints_W{};  ///< From start to goal; empty when none was found.
  Work work{};            ///< `iterations`, `collision_queries`; also when none was found.
  std::string failure{};  ///< Empty on success; else why: `not finite` (a place, the bounds or the
                          ///< body), `start blocked`, `goal blocked`, `no path within N
                          ///< iterations`, `no path shorter than L m`.
};

class PathPlanner : public Kernel {
 public:
  /// How much one search may cost: `PlanRequest::max_iterations` is at most that.
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    return {{"planner.budget",
             "iterations",
             "plan",
             {},
             100.0,
             1e6,
             4000.0,
             "iterations that one search may take"}};
  }
  /// Unknown space may be crossed, occupied cubes may not. Same request and map, same plan.
  [[nodiscard]] virtual Plan plan(const PlanRequest& request, const OccupancyView& map) = 0;
};

}  // namespace flyball
