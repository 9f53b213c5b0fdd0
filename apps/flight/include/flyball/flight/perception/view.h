// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the vehicle's forward camera sees: depth, and colour through the same lens.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/colour_frame.h"
#include "flyball/runtime/messages.h"

namespace flyball {

struct View {
  DepthFrame depth{};
  ColourFrame colour{};
  /// The mount takes out roll and pitch; its encoders say how it stood.
  Pose X_BC{Pose::Identity()};
};

/// Renders both, and turns colour into grey as ITU-R BT.601 does, with the exposure opened up in
/// the shade.
[[nodiscard]] VisualFrame visual_frame(const View& view);

}  // namespace flyball
