// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the vehicle's forward camera sees: depth, and colour through the same lens.

#include "flyball/kernels/visual_frame.h"
#include "flyball/sim/colour_camera.h"
#include "flyball/sim/depth_camera.h"

namespace flyball {

struct View {
  DepthFrame depth{};
  ColourFrame colour{};
  /// The mount takes out roll and pitch; its encoders say how it stood.
  Pose X_BC{Pose::Identity()};
};

/// A colour camera with the depth camera's lens: an RGB-D camera's other half.
[[nodiscard]] ColourCameraSpec colour_beside(const DepthCameraSpec& depth);

/// Renders both, and turns colour into grey as ITU-R BT.601 does, with the exposure opened up in
/// the shade.
[[nodiscard]] VisualFrame visual_frame(const View& view);

}  // namespace flyball
