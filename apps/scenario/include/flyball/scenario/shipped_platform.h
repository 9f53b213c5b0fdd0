// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A modeled computer by its name.

#include "flyball/sim/platform_file.h"

#include <string>

namespace flyball {

/// The platform that `find_shipped` finds.
/// @error Its `not_found`, those of `load_platform`, and `invalid_input` where the prices of one of
/// Flyball's kernels lack what it counts or name what nobody counts: that work would be free.
[[nodiscard]] Result<PlatformModel> find_platform(const std::string& name_or_path);

}  // namespace flyball
