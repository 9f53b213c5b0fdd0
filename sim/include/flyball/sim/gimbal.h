// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Two-axis camera gimbal: pan about the body's z axis, then tilt. Its joints belong to the
/// vehicle's multibody system (`Vehicle`); what drives them is here.

#include "flyball/runtime/geometry.h"

namespace flyball {

/// Mass and size are those of a small camera with its gimbal, rates and stops usual ones.
struct GimbalSpec {
  double mass_kg{0.15};  ///< Of the camera with its mount: a ball of `radius_m` under the body.
  double radius_m{0.05};
  double max_rate_rad_s{1.5707963267948966};  ///< At which it looks elsewhere: 90 degrees/s.
  double max_pan_rad{1.0};                    ///< To either side.
  double min_tilt_rad{-0.5};
  double max_tilt_rad{1.5707963267948966};  ///< Straight down.
};

struct GimbalAngles {
  double pan_rad{};   ///< To the left: from the body's heading, or of the joint.
  double tilt_rad{};  ///< Down: from the horizon, or of the joint.
};

/// Holds the camera's axis where it was told, against the body's roll and pitch. With two joints
/// it cannot hold the image's horizon as well: that leans as the body does.
class GimbalServo {
 public:
  explicit GimbalServo(const GimbalSpec& spec) : spec_{spec} {}

  /// @param command  In the level frame. Beyond the stops it goes to them; what is not finite is
  ///                 not obeyed.
  void aim(const GimbalAngles& command);
  /// Lets the axis move towards what was told, each angle at no more than its rate.
  void slew(double dt_s);

  /// Angles of the joints at which the axis is where it ought to be by now, within the stops.
  [[nodiscard]] GimbalAngles wanted_joints(const Eigen::Matrix3d& R_WB,
                                           const GimbalAngles& joints) const;

  /// Accelerations of the joints [rad/s^2]: a cascade of angle and rate, both proportional; the
  /// rate that is asked for stays within that of the motors.
  [[nodiscard]] GimbalAngles acceleration(const Eigen::Matrix3d& R_WB,
                                          const GimbalAngles& joints,
                                          const GimbalAngles& rates_rad_s) const;

 private:
  GimbalSpec spec_;
  GimbalAngles command_{};
  GimbalAngles aim_{};  ///< On the way to the command.
};

/// Pose of the camera (x right, y down, z forward) in the frame whose x axis is ahead, y left and z
/// up, and against which the angles are measured.
[[nodiscard]] Pose camera_in_level_frame(const GimbalAngles& angles);
/// The level frame L, with the body's origin and heading, upright, in the world.
[[nodiscard]] Pose level_frame(const Pose& X_WB);

}  // namespace flyball
