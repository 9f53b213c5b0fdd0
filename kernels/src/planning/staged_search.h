// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What all shortest-path planners have in common: the easy cases first, then a tree search in a
/// small box around start and goal, then in larger ones.

#include "flyball/kernels/path_planner.h"

#include "planning/motion_checker.h"
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace flyball {

struct SearchStage {
  Vec3 start_W{Vec3::Zero()};
  Vec3 goal_W{Vec3::Zero()};
  Aabb box_W{};  ///< Contains start and goal.
  int max_iterations{};
  std::uint64_t seed{};
  double shorter_than_m{std::numeric_limits<double>::infinity()};
};

struct StageResult {
  std::vector<Vec3> points_W{};  ///< From start to goal; empty when none was found.
  int iterations{};
  std::string error{};  ///< The search itself broke down.
};

using TreeSearch = std::function<StageResult(const SearchStage&, MotionChecker&)>;

/// The search boxes of a request: start and goal with 8 m around them for a quarter of the
/// iterations, with 20 m for another quarter, then the bounds. Boxes that are no larger than the
/// one before are left out, and their iterations go to the next. For a request with a finite
/// `shorter_than_m` one box, around the ellipsoid that holds all such paths (Gammell et al. 2014,
/// doi:10.1109/IROS.2014.6942976).
[[nodiscard]] std::vector<SearchStage> search_stages(const PlanRequest& request);

/// Plans with `search`; the result is simplified.
[[nodiscard]] Plan staged_plan(const PlanRequest& request,
                               const OccupancyView& map,
                               const TreeSearch& search);

}  // namespace flyball
