// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Gimbal: pans and tilts the camera, and keeps it level against the body's roll and pitch.

#include "flyball/runtime/geometry.h"

namespace flyball {

struct GimbalSpec {
  double max_rate_rad_s{1.5707963267948966};  ///< 90 degrees/s: usual for small camera gimbals.
  double max_pan_rad{1.0};                    ///< To either side.
  double min_tilt_rad{-0.5};
  double max_tilt_rad{1.5707963267948966};  ///< Straight down.
};

struct GimbalAngles {
  double pan_rad{};   ///< From the body's heading to the left.
  double tilt_rad{};  ///< From the horizon down.
};

/// Follows its command at no more than its rate; each axis for itself.
class Gimbal {
 public:
  explicit Gimbal(const GimbalSpec& spec = {}, const GimbalAngles& start = {});

  /// Beyond its stops it goes to them. What is not finite is not obeyed.
  void aim(const GimbalAngles& command);
  void step(double dt_s);
  [[nodiscard]] const GimbalAngles& angles() const { return angles_; }

 private:
  GimbalSpec spec_;
  GimbalAngles command_;
  GimbalAngles angles_;
};

/// Pose of the camera (x right, y down, z forward) in the level frame L, which has the body's
/// origin and heading and stands upright.
[[nodiscard]] Pose camera_in_level_frame(const GimbalAngles& angles);
/// L in the world.
[[nodiscard]] Pose level_frame(const Pose& X_WB);

}  // namespace flyball
