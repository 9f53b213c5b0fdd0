// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A delivery over open ground that flies in a second or two of host time.

#include "flyball/simulation/mission.h"

namespace flyball::kit {

inline Scenario short_delivery(double goal_distance_m = 15.0) {
  Scenario scenario;
  scenario.name = "short_delivery";
  scenario.world.generator = "empty";
  scenario.world.parameters["goal_distance_m"] = goal_distance_m;
  scenario.governor.policy = "fixed_coarse";
  scenario.mission.time_limit_s = 120.0;
  return scenario;
}

inline MissionRecord flown(const Scenario& scenario) {
  auto record = fly(scenario, {});
  FLYBALL_ASSERT(record.ok(), "%s", record.error().message.c_str());
  return std::move(*record);
}

}  // namespace flyball::kit
