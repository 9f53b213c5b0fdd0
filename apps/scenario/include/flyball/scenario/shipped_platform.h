// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A modeled computer by its name.

#include "flyball/sim/platform_file.h"

#include <string>

namespace flyball {

/// The platform that `find_shipped` finds.
/// @error Its `not_found`, and those of `load_platform`.
[[nodiscard]] Result<PlatformModel> find_platform(const std::string& name_or_path);

}  // namespace flyball
