// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Reads sim/platforms/NAME.toml, where each number stands with its source.

#include "flyball/runtime/platform.h"

namespace flyball {

/// @error `not_found`, `invalid_input`: unknown keys and impossible values, all in one message.
[[nodiscard]] Result<PlatformModel> load_platform(const std::string& path);

}  // namespace flyball
