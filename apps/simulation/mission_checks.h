// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is wrong with the hooks of a flight, said before it begins.

#include "flyball/flight/brief.h"
#include "flyball/simulation/mission.h"

#include "simulation/mission_setup.h"
#include <string>

namespace flyball {

/// Before the flight: after it a wrong name would cost the map.
[[nodiscard]] Status check_map_name(const std::string& path);
/// A start map brings cells of its own size, and in flight each frame would be refused whose
/// resolution is none of them.
///
/// @param equipment  Whose mapper has read the file, and whose knobs were made before.
[[nodiscard]] Status check_start_map(const std::string& path, const MissionEquipment& equipment);
/// Links, faults and events exist on a modeled computer only.
[[nodiscard]] Status check_executor(const Scenario& scenario, const MissionHooks& hooks);
/// A real depth camera hangs on a real vehicle, alone: no other camera can be real.
[[nodiscard]] Status check_depth_camera(const Scenario& scenario,
                                        const MissionSetup& setup,
                                        const MissionHooks& hooks);

/// The airframe fits where it stands, and above that up to where it flies; where it lands, too. A
/// world's generator does not know the airframe, and a place that was scanned has low things.
[[nodiscard]] Status check_room(const SimulatedThings& things, bool lands_at_goal);

/// A vehicle leaves the space that is declared clear around its start into space that its camera
/// has seen, so that has to begin where the clear space ends, over the whole height of the body
/// with its tube. A camera that looks up or down by half its field or more is left out, and so is a
/// vehicle with the error of the simulated controller: it may call the place free where it rests.
/// What this lets pass may still stall: cells are as wide as the error.
[[nodiscard]] Status check_start(const Brief& brief);

}  // namespace flyball
