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

/// With the box drawn: in green what was right, in red what was not.
[[nodiscard]] MissionFrame boxed(ColourImage image,
                                 const ImageBox& box,
                                 bool is_right,
                                 std::string caption);

}  // namespace flyball
