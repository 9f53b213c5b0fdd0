// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A picture that a mission took, for its report.

#include "flyball/runtime/colour_image.h"

#include <string>

namespace flyball {

struct MissionFrame {
  std::string caption;
  ColourImage image{};  ///< With whatever was drawn on it.
};

}  // namespace flyball
