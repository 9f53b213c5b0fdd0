// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A planner's zigzag in, few way-points out.

#include "flyball/kernels/path_planner.h"

#include "planning/motion_checker.h"
#include <vector>

namespace flyball {

/// Shortcuts, drops superfluous way-points, then moves the rest away from obstacles where that
/// blocks nothing, unless the vehicle is slow there in any case. Start and goal stay exactly; every
/// piece of the result is flyable if every piece of `points_W` is. Points closer than .2 m are
/// merged where their neighbours allow it.
///
/// @param request  Points are moved only to places inside its bounds.
/// @pre At least two points.
[[nodiscard]] std::vector<Vec3> simplify(std::vector<Vec3> points_W,
                                         MotionChecker& checker,
                                         const PlanRequest& request);

}  // namespace flyball
