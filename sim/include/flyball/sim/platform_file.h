// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Reads sim/platforms/NAME.toml, where each number stands with its source.

#include "flyball/runtime/platform.h"

#include <string>
#include <vector>

namespace flyball {

/// A file may be like another one (`like = "jetson_tx2"`): then its own top-level keys, and each of
/// its kernels, replace that one's as a whole.
///
/// @param shipped  A folder where the other one may be, too, if it is not beside this one.
/// @error `not_found`, `invalid_input`: unknown keys and impossible values, all in one message.
[[nodiscard]] Result<PlatformModel> load_platform(const std::string& path,
                                                  const std::string& shipped = "");

/// The files that a platform comes from: its own, and the one that it is like.
[[nodiscard]] std::vector<std::string> files_of_platform(const std::string& path,
                                                         const std::string& shipped = "");

}  // namespace flyball
