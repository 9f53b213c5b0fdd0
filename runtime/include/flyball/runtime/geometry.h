// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Vectors, poses and the few shapes that travel between modules. SI units, radians.
/// Frames: W world (x east, y north, z up), B body (x forward, y left, z up), C camera (x right,
/// y down, z forward).

#include <Eigen/Geometry>

namespace flyball {

using Vec3 = Eigen::Vector3d;
using Pose = Eigen::Isometry3d;  ///< X_WB: takes points of B to W.

/// Axis-aligned box in W [m].
struct Aabb {
  Vec3 min{Vec3::Zero()};
  Vec3 max{Vec3::Zero()};
  [[nodiscard]] bool contains(const Vec3& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
  /// The point of the box that is nearest; p itself inside.
  [[nodiscard]] Vec3 nearest(const Vec3& p) const { return p.cwiseMax(min).cwiseMin(max); }
  /// To the nearest point of the box [m]; 0 inside.
  [[nodiscard]] double distance_m(const Vec3& p) const { return (p - nearest(p)).norm(); }
};

/// Upright cylinder around a centre: the vehicle's body with or without its tracking tube [m].
struct Cylinder {
  double radius_m{};
  double half_height_m{};
};

/// Heading of a direction, from x towards y [rad].
[[nodiscard]] inline double yaw_of(const Vec3& direction) {
  return std::atan2(direction.y(), direction.x());
}

/// To (-pi, pi].
[[nodiscard]] inline double wrap_angle(double angle_rad) {
  return std::atan2(std::sin(angle_rad), std::cos(angle_rad));
}

}  // namespace flyball
