// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a plan leads to when the goal is too far to plan to at once.

#include "flyball/flight/mission_context.h"

namespace flyball {

/// The goal, when it is within `planner.horizon_m` of the start or the horizon is 0. Else a place
/// about that far on the straight way, or beside it, where the body may be as far as the map knows.
///
/// @param failures  Plans that failed in a row: each makes the next place be tried, because a place
///                  that looks free may be walled in.
[[nodiscard]] Vec3 sub_goal_W(const MissionContext& context,
                              const Vec3& start_W,
                              const Vec3& goal_W,
                              int failures);

}  // namespace flyball
