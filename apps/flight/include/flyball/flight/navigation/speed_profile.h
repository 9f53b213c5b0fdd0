// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How fast each place of a path may be passed, however fast the computer is.

#include "flyball/runtime/trajectory.h"

#include <functional>
#include <vector>

namespace flyball {

struct SpeedProfileLimits {
  /// Each is half of the 6 m/s^2 that the guard may brake with, so that both together stay below
  /// it.
  double lateral_m_s2{3.0};
  double longitudinal_m_s2{3.0};
  /// A stop from v takes v^2 / 2a + v lag. At slow speed the vehicle lags behind a braking
  /// reference by .07 s (tests/sim/flight_controller_test.cpp) and would otherwise overshoot a
  /// corner.
  double lag_s{0.1};
  double turn_rad_s{1.2};  ///< Of the heading, which follows the velocity; below its 90 degrees/s.
};

/// The largest speeds along a path that respect curvature, the limits of places and the standstill
/// at the end, with the given accelerations (a backward pass over the samples).
class SpeedProfile {
 public:
  SpeedProfile() = default;
  /// @param place_limit  Speed limit at a place (slow zones); positive.
  SpeedProfile(const Path& path,
               const SpeedProfileLimits& limits,
               const std::function<double(const Vec3&)>& place_limit);
  /// Interpolates linearly in v^2 between samples. @pre The path was not empty.
  [[nodiscard]] double at(double s_m) const;

 private:
  std::vector<double> s_m_;
  std::vector<double> speed_squared_;
};

}  // namespace flyball
