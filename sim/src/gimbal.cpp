// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/gimbal.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

double towards(double from, double to, double largest) {
  return from + std::clamp(to - from, -largest, largest);
}

}  // namespace

Gimbal::Gimbal(const GimbalSpec& spec, const GimbalAngles& start)
    : spec_{spec}, command_{start}, angles_{start} {}

void Gimbal::aim(const GimbalAngles& command) {
  if (std::isfinite(command.pan_rad) && std::isfinite(command.tilt_rad)) {
    command_.pan_rad = std::clamp(command.pan_rad, -spec_.max_pan_rad, spec_.max_pan_rad);
    command_.tilt_rad = std::clamp(command.tilt_rad, spec_.min_tilt_rad, spec_.max_tilt_rad);
  }
}

void Gimbal::step(double dt_s) {
  const double most_rad = spec_.max_rate_rad_s * dt_s;
  angles_.pan_rad = towards(angles_.pan_rad, command_.pan_rad, most_rad);
  angles_.tilt_rad = towards(angles_.tilt_rad, command_.tilt_rad, most_rad);
}

Pose camera_in_level_frame(const GimbalAngles& angles) {
  Eigen::Matrix3d R_LC;  // clang-format off
  R_LC << 0, 0, 1,
         -1, 0, 0,
          0, -1, 0;  // clang-format on
  Pose X_LC = Pose::Identity();
  X_LC.linear() = Eigen::AngleAxisd{angles.pan_rad, Vec3::UnitZ()}.toRotationMatrix() *
                  Eigen::AngleAxisd{angles.tilt_rad, Vec3::UnitY()}.toRotationMatrix() * R_LC;
  return X_LC;
}

Pose level_frame(const Pose& X_WB) {
  Pose X_WL = Pose::Identity();
  X_WL.linear() = Eigen::AngleAxisd{yaw_of(X_WB.linear().col(0)), Vec3::UnitZ()}.toRotationMatrix();
  X_WL.translation() = X_WB.translation();
  return X_WL;
}

}  // namespace flyball
