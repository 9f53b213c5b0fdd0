// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A delivery over open ground that flies in a second or two of host time; and a flight's record,
/// with what its trace says.

#include "flyball/simulation/mission.h"

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

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

/// Whether the trace has this text.
inline bool says(const MissionRecord& record, const std::string& what) {
  for (const auto& row : record.trace->rows()) {
    for (const auto& field : row.fields) {
      const auto* text = std::get_if<std::string>(&field.value);
      if (text != nullptr && *text == what) {
        return true;
      }
    }
  }
  return false;
}

/// A field of what the governor observed, for each look that recorded it.
inline std::vector<double> observed(const MissionRecord& record, std::string_view name) {
  std::vector<double> values;
  for (const auto& row : record.trace->rows()) {
    for (const auto& field : row.fields) {
      if (row.channel == "observation" && field.name == name) {
        values.push_back(std::get<double>(field.value));
      }
    }
  }
  return values;
}

}  // namespace flyball::kit
