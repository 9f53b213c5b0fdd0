// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The place that a plan leads to when the goal is too far away for one plan.

#include "flyball/flight/navigation/situation.h"

namespace flyball {

/// The goal itself, when it is within `planner.horizon_m` of the start or the horizon is 0.
/// Otherwise a place about that far away, on the straight line or beside it, that the map does not
/// show as blocked for the body.
///
/// @param failures  Plans that failed in a row: each one moves on to the next candidate, because a
///                  place that looks free may be walled in.
[[nodiscard]] Vec3 sub_goal_W(const Situation& situation,
                              const Vec3& start_W,
                              const Vec3& goal_W,
                              int failures);

/// The first part of a way that was flown, as far as it is free on the map. Empty where it is so
/// short that a search may find a better one.
[[nodiscard]] std::vector<Vec3> free_leg_W(const Situation& situation, std::vector<Vec3> flown_W);

}  // namespace flyball
