// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Turns text into keys and values. It knows TOML, but not what the keys mean.

#include "flyball/scenario/override.h"

#include "scenario/scenario_fields.h"
#include <map>
#include <string>
#include <vector>

namespace flyball {

using GivenValues = std::map<std::string, GivenValue>;

/// ` (mine.toml:7)`, where the value of a setting was given; nothing for a default.
[[nodiscard]] std::string place_of(const std::string& key, const GivenValues& given);

/// The given values by key, and errors for what could not be read.
struct ScenarioText {
  GivenValues values{};
  std::vector<Error> errors{};
};

/// Keys of sections are joined with a dot: `map.range_m`; tables in a list are numbered from 1:
/// `events.1.at_s`.
[[nodiscard]] ScenarioText read_scenario_file(const std::string& path);
/// Overrides one value by `KEY=VALUE`. A value that is not TOML counts as a text without quotes.
void read_override(const Override& override, ScenarioText& read);

}  // namespace flyball
