// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/gimbal.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Own choices: 80 rad/s, as small brushless gimbals reach, critically damped.
constexpr double per_angle_1_s = 40.0;
constexpr double rate_lag_s = 0.00625;
constexpr double fastest_motor_rad_s = 6.0;

}  // namespace

void GimbalServo::aim(const GimbalAngles& command) {
  if (std::isfinite(command.pan_rad) && std::isfinite(command.tilt_rad)) {
    command_.pan_rad = std::clamp(command.pan_rad, -spec_.max_pan_rad, spec_.max_pan_rad);
    command_.tilt_rad = std::clamp(command.tilt_rad, spec_.min_tilt_rad, spec_.max_tilt_rad);
  }
}

void GimbalServo::slew(double dt_s) {
  const double most_rad = spec_.max_rate_rad_s * dt_s;
  const auto towards = [&](double from_rad, double to_rad) {
    return from_rad + std::clamp(to_rad - from_rad, -most_rad, most_rad);
  };
  aim_ = {towards(aim_.pan_rad, command_.pan_rad), towards(aim_.tilt_rad, command_.tilt_rad)};
}

GimbalJoints GimbalServo::wanted_joints(const Eigen::Matrix3d& R_WB) const {
  Pose X_WB = Pose::Identity();
  X_WB.linear() = R_WB;
  // R = Rz(pan) Rx(roll) Ry(tilt)
  const Eigen::Matrix3d R = R_WB.transpose() * level_frame(X_WB).linear() * gimbal_rotation(aim_);
  return {std::clamp(std::atan2(-R(0, 1), R(1, 1)), -spec_.max_pan_rad, spec_.max_pan_rad),
          std::clamp(std::asin(std::clamp(R(2, 1), -1.0, 1.0)), -spec_.max_roll_rad,
                     spec_.max_roll_rad),
          std::clamp(std::atan2(-R(2, 0), R(2, 2)), spec_.min_tilt_rad, spec_.max_tilt_rad)};
}

GimbalJoints GimbalServo::acceleration(const Eigen::Matrix3d& R_WB,
                                       const GimbalJoints& joints_rad,
                                       const GimbalJoints& rates_rad_s) const {
  const GimbalJoints wanted = wanted_joints(R_WB);
  const auto joint = [](double goal_rad, double angle_rad, double rate_rad_s) {
    const double rate_goal_rad_s = std::clamp(per_angle_1_s * (goal_rad - angle_rad),
                                              -fastest_motor_rad_s, fastest_motor_rad_s);
    return (rate_goal_rad_s - rate_rad_s) / rate_lag_s;
  };
  return {joint(wanted.pan, joints_rad.pan, rates_rad_s.pan),
          joint(wanted.roll, joints_rad.roll, rates_rad_s.roll),
          joint(wanted.tilt, joints_rad.tilt, rates_rad_s.tilt)};
}

}  // namespace flyball
