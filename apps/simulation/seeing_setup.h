// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a mission needs that sees in colour: cameras, detector, trackers.

#include "flyball/scenario/scenario.h"

#include "flight/mission_context.h"

namespace flyball {

/// The detector that the scenario names, started.
///
/// @error `not_found` (no such detector; weights, cascades), `invalid_input` (a parameter).
[[nodiscard]] Result<std::unique_ptr<Detector>> make_detector(const Scenario& scenario);

/// Whose cost a detection is charged as on the modeled computer.
[[nodiscard]] std::string detector_cost(const Scenario& scenario);

/// Adds camera, detector and trackers to `equipment` if the scenario's workload looks for people,
/// and an eye if its localizer sees.
///
/// @error As `make_detector`; and a mesh of somebody in the world that is missing, a detector,
///        tracker or seeing localizer that the platform has no price for.
[[nodiscard]] Status equip_to_see(const Scenario& scenario,
                                  const Platform& platform,
                                  const World& world,
                                  MissionEquipment& equipment);

}  // namespace flyball
