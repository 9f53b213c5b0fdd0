// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Values that replace those of a scenario's file, with the option that the user gave them by.

#include "flyball/scenario/scenario.h"

#include <string>
#include <variant>
#include <vector>

namespace flyball {

struct Override {
  std::string key_and_value;    ///< `map.range_m=5`
  std::string option{"--set"};  ///< Named by what is said of the value.
};

/// A key or a value without the blanks and tabs around it, which belong to neither.
[[nodiscard]] std::string trimmed(const std::string& text);
/// The trimmed key of `KEY=VALUE`, or the whole text where it has no `=`.
[[nodiscard]] std::string key_of(const std::string& key_and_value);

/// What `--set` gave, as overrides.
[[nodiscard]] std::vector<Override> of_set(const std::vector<std::string>& keys_and_values);

/// As `load_scenario`, which takes every override for one of `--set`.
[[nodiscard]] std::variant<LoadedScenario, std::vector<Error>> load_overridden_scenario(
    const std::string& name_or_path,
    const std::vector<Override>& overrides,
    const Plugins& plugins = {});

}  // namespace flyball
