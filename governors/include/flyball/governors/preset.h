// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy with its parameters, read from policies/presets/NAME.toml:
///     policy = "density"
///     [parameters]
///     fine_m = 0.15
/// or two presets that fly together, one for the application and one for the clock:
///     application = "two_level"
///     clock = "schedutil_10ms"

#include "flyball/runtime/parameters.h"

#include <map>
#include <string>

namespace flyball {

struct Preset {
  std::string policy;  ///< Empty in a combination.
  std::map<std::string, ParameterValue> parameters{};
  std::string description{};
  std::string application{};  ///< A preset or policy; empty but in a combination.
  std::string clock{};        ///< Another one, whose clock is taken.

  [[nodiscard]] bool is_combination() const { return !application.empty(); }
};

/// @error `not_found`, `invalid_input` with the file's name and line.
[[nodiscard]] Result<Preset> load_preset(const std::string& path);
/// Parameters alone, from text as it stands below [parameters]: `fine_m = 0.15`, a line for each.
/// @error `invalid_input` with the line.
[[nodiscard]] Result<std::map<std::string, ParameterValue>> read_parameters(
    const std::string& text);

}  // namespace flyball
