// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Turns the names in a scenario into things: platform, airframe, world, kernels, governor.

#include "flyball/flight/mission_context.h"
#include "flyball/governors/policy_governor.h"
#include "flyball/scenario/knobs.h"

#include "simulation/simulated_things.h"
#include <memory>

namespace flyball {

struct MissionSetup {
  std::unique_ptr<ModeledPlatform> platform;
  SimulatedThings things;
  MissionEquipment equipment;
  std::unique_ptr<PolicyGovernor> governor;
};

/// What a world's file declares to the vehicle before take-off.
[[nodiscard]] MissionBrief brief_of(const World& world, const std::string& name);

/// @error `not_found` or `invalid_input`: one sentence with the name and the way out.
[[nodiscard]] Result<MissionSetup> set_up(const Scenario& scenario);
/// For whoever asks about a mission that nobody governs: the policy is not even loaded, so a
/// scenario of somebody else runs no code of theirs. `governor` is null.
[[nodiscard]] Result<MissionSetup> set_up_without_governor(const Scenario& scenario);

}  // namespace flyball
