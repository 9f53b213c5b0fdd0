// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Everything that was ever fitted, to what: agreement with these figures shows nothing.

#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

struct Fitted {
  std::string what{};   ///< A parameter, a scene or a texture.
  std::string value{};  ///< Empty: no single number.
  std::string to{};     ///< What it was fitted to.
  std::string where{};  ///< The file that holds it.
};

/// With the scales as the shipped platform file has them.
/// @error As `load_platform`.
[[nodiscard]] Result<std::vector<Fitted>> fitted_values();

}  // namespace flyball
