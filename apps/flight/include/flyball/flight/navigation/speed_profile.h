// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How fast each place of a path may be passed, whatever the computer can do.

#include "flyball/runtime/trajectory.h"

#include <functional>
#include <vector>

namespace flyball {

struct SpeedProfileLimits {
  double lateral_m_s2{3.0};       ///< Half of the 6 m/s^2 that the guard may brake with,
  double longitudinal_m_s2{3.0};  ///< so that both together stay below it.
  /// A stop from v takes v^2 / 2a + v lag: at a crawl the vehicle lags behind a braking reference
  /// by .07 s (tests/sim/flight_controller_test.cpp), and would swing beyond a corner.
  double lag_s{0.1};
  double turn_rad_s{1.2};  ///< Of the heading, which follows the velocity: below its 90 degrees/s.
};

/// Largest speeds along a path such that curvature, places and the standstill at its end are
/// respected with the given decelerations (backward pass over the samples).
class SpeedProfile {
 public:
  SpeedProfile() = default;
  /// @param place_limit  Speed limit at a place (zones); positive.
  SpeedProfile(const Path& path,
               const SpeedProfileLimits& limits,
               const std::function<double(const Vec3&)>& place_limit);
  /// Linear in v^2 between samples. @pre the path was not empty.
  [[nodiscard]] double at(double s_m) const;

 private:
  std::vector<double> s_m_;
  std::vector<double> speed_squared_;
};

}  // namespace flyball
