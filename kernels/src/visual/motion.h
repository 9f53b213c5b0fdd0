// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Small motions of a rigid body as vectors (p, r): a shift and a rotation vector.

#include "flyball/runtime/geometry.h"

namespace flyball {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// skew(a) b = a x b.
[[nodiscard]] inline Eigen::Matrix3d skew(const Vec3& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

/// Rotation by |r| around r.
[[nodiscard]] inline Eigen::Matrix3d rotation_of(const Vec3& r_rad) {
  const double angle_rad = r_rad.norm();
  return angle_rad < 1e-12
             ? Eigen::Matrix3d{Eigen::Matrix3d::Identity() + skew(r_rad)}
             : Eigen::Matrix3d{Eigen::AngleAxisd{angle_rad, r_rad / angle_rad}.toRotationMatrix()};
}

/// The inverse of `rotation_of`, for angles below pi.
[[nodiscard]] inline Vec3 rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn{R};
  return turn.angle() * turn.axis();
}

/// The pose moved by (p, r), both expressed in its own frame.
[[nodiscard]] inline Pose moved(const Pose& X, const Vec6& by) {
  Pose result = X;
  result.translation() += X.linear() * by.head<3>();
  result.linear() =
      Eigen::Quaterniond{X.linear() * rotation_of(by.tail<3>())}.normalized().toRotationMatrix();
  return result;
}

/// How an error (p, r) of a pose's own frame becomes one of another frame that is fixed to it.
/// @param X_TF  The first frame, seen from the second.
[[nodiscard]] inline Matrix6 carried(const Pose& X_TF) {
  const Eigen::Matrix3d R_TF = X_TF.linear();
  const Vec3 p_FT = -(R_TF.transpose() * X_TF.translation());
  Matrix6 by = Matrix6::Zero();
  by.topLeftCorner<3, 3>() = by.bottomRightCorner<3, 3>() = R_TF;
  by.topRightCorner<3, 3>() = -R_TF * skew(p_FT);  // r turns T around F: r x p_FT.
  return by;
}

}  // namespace flyball
