// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One plan is several questions to the planner: how wide may the vehicle's tube be, and does a
/// narrower one save a detour?

#include "flyball/flight/navigation/navigator.h"

namespace flyball {

/// One request, with the tube that cruise speed needs, and room beside it, where both fit, else
/// with a narrower one; all within the knob `planner.budget`. If the way found is a detour, a much
/// shorter one is looked for with the narrowest tube: the first path of a sampling planner goes
/// around a house as likely as through its door.
///
/// @param body  Out: for which the plan was found.
/// @return      Its work is that of all attempts.
[[nodiscard]] Plan plan_with_tubes(MissionContext& context, const PlanQuery& query, Cylinder& body);

}  // namespace flyball
