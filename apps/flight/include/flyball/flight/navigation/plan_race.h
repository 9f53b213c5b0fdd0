// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Several searches for one path, side by side.

#include "flyball/kernels/path_planner.h"

namespace flyball {

/// Adds the work of `more` to `sum`, with what of it several cores can share.
void add(Work& sum, const Work& more);

/// `searches` searches that differ in their seeds, in lock-step of iterations: the first that finds
/// a path ends all of them, and of those that find one in the same iteration the first by number
/// wins. A sampling planner's time has a long tail before a narrow passage, so that the first of
/// several comes much earlier than the usual one. Each search gets an equal part of
/// `request.max_iterations`. The searches are computed one after the other; the work, and what of
/// it is shared, is what they would have done side by side until the end of the race.
///
/// @param request  The first search takes its seed, so that a race of one is `planner.plan`.
/// @pre `searches >= 1`.
[[nodiscard]] Plan race_of(int searches,
                           PathPlanner& planner,
                           const PlanRequest& request,
                           const OccupancyView& map);

}  // namespace flyball
