// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a mission needs that sees in colour: cameras, detector, trackers.

#include "flyball/runtime/platform.h"
#include "flyball/scenario/scenario.h"

#include "simulation/mission_equipment.h"
#include "simulation/simulated_things.h"

namespace flyball {

/// A colour camera with the depth camera's lens: an RGB-D camera's other half.
[[nodiscard]] ColourCameraSpec colour_beside(const DepthCameraSpec& depth);

/// Adds detector and trackers to `equipment` if the scenario's workload looks for people, and a
/// forward camera if its localizer takes images.
///
/// @error As `make_kernel`; and a mesh of somebody in the world that is missing, a detector,
///        tracker or localizer that takes images that the platform has no price for.
[[nodiscard]] Result<ColourCameras> equip_to_see(const Scenario& scenario,
                                                 const Platform& platform,
                                                 const World& world,
                                                 MissionEquipment& equipment);

}  // namespace flyball
