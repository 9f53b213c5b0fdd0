// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a camera gimbal points, and the frame against which that is measured.

#include "flyball/runtime/geometry.h"

namespace flyball {

struct GimbalAngles {
  double pan_rad{};   ///< From the body's heading to the left.
  double tilt_rad{};  ///< From the horizon down.
};

/// Rz(pan) Ry(tilt): from the camera's upright axes ahead to those of the level frame.
[[nodiscard]] Eigen::Matrix3d gimbal_rotation(const GimbalAngles& angles);
/// Pose of the camera (x right, y down, z forward) in the frame whose x axis is ahead, y left and z
/// up, and against which the angles are measured.
[[nodiscard]] Pose camera_in_level_frame(const GimbalAngles& angles);
/// The level frame L, with the body's origin and heading, upright, in the world.
[[nodiscard]] Pose level_frame(const Pose& X_WB);

}  // namespace flyball
