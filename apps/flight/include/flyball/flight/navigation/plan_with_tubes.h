// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One plan takes several searches: how wide may the vehicle's tube be, and does a narrower tube
/// save a detour?

#include "flyball/flight/navigation/plan_service.h"
#include "flyball/flight/navigation/situation.h"
#include "flyball/kernels/path_planner.h"

namespace flyball {

/// Answers one request. The first search asks for the tube of cruise speed with room beside it;
/// later ones ask for narrower tubes. Each search keeps to the knob `planner.budget`. If the path
/// is a detour, a much shorter one is searched for with the narrowest tube, because the first path
/// of a sampling planner leads around a house as likely as through its door.
///
/// @param body  Out: the body, with its tube, that the plan was found for.
/// @return      The plan; its work is that of all searches.
[[nodiscard]] Plan plan_with_tubes(const Situation& situation,
                                   PathPlanner& planner,
                                   const PlanQuery& query,
                                   Cylinder& body);

}  // namespace flyball
