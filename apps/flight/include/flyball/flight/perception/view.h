// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the vehicle's forward RGB-D camera sees: depth, and colour through the same lens.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/colour_frame.h"
#include "flyball/runtime/messages.h"

namespace flyball {

struct View {
  DepthFrame depth{};
  ColourFrame colour{};
  /// Pose of the camera in the body. The mount compensates roll and pitch; its encoders measure by
  /// how much.
  Pose X_BC{Pose::Identity()};
};

/// Renders both images and converts colour to grey as ITU-R BT.601 does, with a longer exposure in
/// the shade.
[[nodiscard]] VisualFrame visual_frame(const View& view);

}  // namespace flyball
