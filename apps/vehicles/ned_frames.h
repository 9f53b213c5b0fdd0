// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The only place that knows how an autopilot's axes lie in ours. N is its local frame (x north,
/// y east, z down), D its body frame (x forward, y right, z down); W and B are ours (geometry.h).

#include "flyball/runtime/geometry.h"

#include <cmath>

namespace flyball {

/// A direction of N in W. x and y change places and z its sign; it is its own inverse.
[[nodiscard]] inline Vec3 north_east_down_turned(const Vec3& v) {
  return {v.y(), v.x(), -v.z()};
}

/// A direction of D in B, and back.
[[nodiscard]] inline Vec3 forward_right_down_turned(const Vec3& v) {
  return {v.x(), -v.y(), -v.z()};
}

/// R_WB from R_ND.
[[nodiscard]] inline Eigen::Quaterniond q_WB_of(const Eigen::Quaterniond& q_ND) {
  // R_WN swaps the first two axes and turns the third round: half a turn about (1, 1, 0).
  const double half = std::sqrt(0.5);
  const Eigen::Quaterniond q_WN{0.0, half, half, 0.0};
  const Eigen::Quaterniond q_DB{0.0, 1.0, 0.0, 0.0};  // Half a turn about forward.
  return (q_WN * q_ND * q_DB).normalized();
}

/// Yaw from east, anticlockwise, becomes yaw from north, clockwise, in (-pi, pi]; and back.
[[nodiscard]] inline double yaw_turned(double yaw_rad) {
  return wrap_angle(std::acos(0.0) - yaw_rad);
}

/// Places of N and W: what the autopilot calls `start_N` is `start_W` in the mission's world.
struct LocalOrigin {
  Vec3 start_N{Vec3::Zero()};
  Vec3 start_W{Vec3::Zero()};

  [[nodiscard]] Vec3 to_W(const Vec3& p_N) const {
    return start_W + north_east_down_turned(p_N - start_N);
  }
  [[nodiscard]] Vec3 to_N(const Vec3& p_W) const {
    return start_N + north_east_down_turned(p_W - start_W);
  }
};

}  // namespace flyball
