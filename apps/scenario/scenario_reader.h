// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Text in, keys and values out. Knows TOML, but not what the keys mean.

#include "scenario/scenario_fields.h"
#include <map>
#include <string>
#include <vector>

namespace flyball {

using GivenValues = std::map<std::string, GivenValue>;

/// What somebody wrote: values by key, and what could not be read as any.
struct ScenarioText {
  GivenValues values{};
  std::vector<Error> errors{};
};

/// Keys of sections are joined with a dot: `map.range_m`; tables in a list are numbered from 1:
/// `events.1.at_s`.
[[nodiscard]] ScenarioText read_scenario_file(const std::string& path);
/// Puts `KEY=VALUE` on top of what was read. A value that is no TOML is a text without quotes.
void read_override(const std::string& key_and_value, ScenarioText& read);

}  // namespace flyball
