// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Camera gimbal: pan and tilt are commanded, and a third motor between them keeps the horizon
/// level. Its joints belong to the vehicle's multibody system (`Vehicle`); what drives them is
/// here.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/gimbal.h"

namespace flyball {

/// Mass and size are those of a small camera with its gimbal, rates and stops usual ones.
struct GimbalSpec {
  double mass_kg{0.15};  ///< Of the camera with its mount: a ball of `radius_m` under the body.
  double radius_m{0.05};
  double max_rate_rad_s{1.5707963267948966};  ///< At which it looks elsewhere: 90 degrees/s.
  double max_pan_rad{1.0};                    ///< To either side.
  double min_tilt_rad{-0.5};
  double max_tilt_rad{1.5707963267948966};  ///< Straight down.
  double max_roll_rad{0.8};
};

/// Angles of the joints, or their rates or accelerations: about the body's z axis, then x, then y.
struct GimbalJoints {
  double pan{};
  double roll{};
  double tilt{};
};

/// Holds the camera where it was told and upright, against the body's roll and pitch.
class GimbalServo {
 public:
  explicit GimbalServo(const GimbalSpec& spec) : spec_{spec} {}

  /// @param command  In the level frame. Beyond the stops it goes to them; what is not finite is
  ///                 not obeyed.
  void aim(const GimbalAngles& command);
  /// Lets the axis move towards what was told, each angle at no more than its rate.
  void slew(double dt_s);

  /// Angles of the joints [rad] at which the axis is where it ought to be by now, within the stops.
  [[nodiscard]] GimbalJoints wanted_joints(const Eigen::Matrix3d& R_WB) const;

  /// Accelerations of the joints [rad/s^2]: a cascade of angle and rate, both proportional; the
  /// rate that is asked for stays within that of the motors.
  [[nodiscard]] GimbalJoints acceleration(const Eigen::Matrix3d& R_WB,
                                          const GimbalJoints& joints_rad,
                                          const GimbalJoints& rates_rad_s) const;

 private:
  GimbalSpec spec_;
  GimbalAngles command_{};
  GimbalAngles aim_{};  ///< Moves towards the command.
};

}  // namespace flyball
