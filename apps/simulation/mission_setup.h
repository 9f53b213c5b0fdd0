// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Turns the names in a scenario into things: platform, airframe, world, kernels, governor.

#include "flyball/flight/brief.h"
#include "flyball/flight/navigation/situation.h"
#include "flyball/governors/policy_governor.h"
#include "flyball/runtime/edge.h"
#include "flyball/scenario/knobs.h"

#include "simulation/mission_equipment.h"
#include "simulation/simulated_things.h"
#include <memory>
#include <optional>

namespace flyball {

struct MissionSetup {
  std::shared_ptr<const ModeledPlatform> platform;  ///< Owners: this and the brief.
  std::optional<EdgeModel> edge{};                  ///< Empty: there is no edge computer.
  SimulatedThings things;
  MissionEquipment equipment;
  std::unique_ptr<PolicyGovernor> governor;
};

/// What a world's file declares to the vehicle before take-off.
[[nodiscard]] Site site_of(const World& world, const std::string& name);

/// What is known on board of a mission that has been set up. @param scenario  The one it was set up
/// from.
[[nodiscard]] Brief brief_of(const Scenario& scenario, const MissionSetup& setup);

/// For callers that use kernels one by one, without a graph.
struct Workbench {
  Brief brief{};
  KnobsInForce knobs{};
  MissionKernels kernels{};
  /// Goes by the mapper's own view; valid until the mapper is used again.
  [[nodiscard]] Situation situation() const { return {brief, knobs, kernels.mapper->view()}; }
};
[[nodiscard]] Workbench workbench_of(const Scenario& scenario, const MissionSetup& setup);

/// @param clock  Of the governor's watchdog. Null: it has none, because the time of a modeled
///               computer is not the host's, and a mission must not depend on that.
/// @error `not_found` or `invalid_input`: one sentence with the name and the way out.
[[nodiscard]] Result<MissionSetup> set_up(const Scenario& scenario,
                                          PolicyGovernor::HostClock clock = nullptr);
/// The same without a governor: `governor` is null. The policy is not even loaded, so a scenario
/// from somebody else cannot run their code.
[[nodiscard]] Result<MissionSetup> set_up_without_governor(const Scenario& scenario);

}  // namespace flyball
