// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/gimbal.h"

namespace flyball {

Eigen::Matrix3d gimbal_rotation(const GimbalAngles& angles) {
  return (Eigen::AngleAxisd{angles.pan_rad, Vec3::UnitZ()} *
          Eigen::AngleAxisd{angles.tilt_rad, Vec3::UnitY()})
      .toRotationMatrix();
}

Pose camera_in_level_frame(const GimbalAngles& angles) {
  Eigen::Matrix3d R_LC;  // clang-format off
  R_LC << 0, 0, 1,
         -1, 0, 0,
          0, -1, 0;  // clang-format on
  Pose X_LC = Pose::Identity();
  X_LC.linear() = gimbal_rotation(angles) * R_LC;
  return X_LC;
}

Pose level_frame(const Pose& X_WB) {
  Pose X_WL = Pose::Identity();
  X_WL.linear() = Eigen::AngleAxisd{yaw_of(X_WB.linear().col(0)), Vec3::UnitZ()}.toRotationMatrix();
  X_WL.translation() = X_WB.translation();
  return X_WL;
}

}  // namespace flyball
