// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy with its parameters, read from policies/presets/NAME.toml:
///     policy = "density"
///     [parameters]
///     fine_m = 0.15

#include "flyball/runtime/parameters.h"

#include <map>
#include <string>

namespace flyball {

struct Preset {
  std::string policy;
  std::map<std::string, ParameterValue> parameters{};
  std::string description{};
};

/// @error `not_found`, `invalid_input` with the file's name and line.
[[nodiscard]] Result<Preset> load_preset(const std::string& path);

}  // namespace flyball
