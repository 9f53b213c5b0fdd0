// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The braking invariant: the committed path always ends stopped inside known-free space.
/// Not pluggable; a wrong governor costs time, never a collision, as long as obstacles are static,
/// the map is sound and the brake model holds.

#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/trajectory.h"

#include <array>
#include <cstddef>

namespace flyball {

/// Largest speed from which the vehicle stops within `distance_m` after reacting for `delta_s`:
/// v = a (sqrt(delta^2 + 2 d / a) - delta), MAVBench (MICRO 2018) eq. 2. Zero for d <= 0, and for a
/// delta that is negative or not finite: nobody can react within such a time.
/// @pre `deceleration_m_s2 > 0`.
[[nodiscard]] double safe_speed(double deceleration_m_s2, double delta_s, double distance_m);

/// The tube that the body needs around its reference at a speed: e(v) [m].
struct TrackingTube {
  double at_rest_m{0.02};
  double per_m_s{0.01};  ///< Measured, as is the other: tests/sim/flight_controller_test.cpp.
  /// Up and down beyond the radius: each change of tilt costs height for a moment (.02 m in 98 of
  /// 100 samples of a delivery), and no door is as narrow that way.
  double extra_height_m{0.03};
  [[nodiscard]] double radius_m(double speed_m_s) const { return at_rest_m + per_m_s * speed_m_s; }
};

/// Distance from the span's beginning to the first place where the body (its centre on the path) is
/// not in known-free space; at most the horizon.
/// @cost One body query per `step_m`; `step_m` <= half the finest cell leaves no gap.
[[nodiscard]] double known_free_distance(const OccupancyView& map,
                                         const PathSpan& span,
                                         const Cylinder& body,
                                         double step_m = 0.05);

struct GuardSettings {
  double max_deceleration_m_s2{6.0};  ///< MAVBench's a.
  Duration tick{std::chrono::milliseconds{20}};
  /// Measured: .069 s at most in stops from 1, 3, 6, 9 m/s (tests/sim/flight_controller_test.cpp).
  Duration brake_lag{std::chrono::milliseconds{100}};
  Duration command_age{std::chrono::milliseconds{20}};

  /// t_b = tick + age of the command + brake lag.
  [[nodiscard]] Duration reaction_time() const { return tick + command_age + brake_lag; }
};

class Guard {
 public:
  explicit Guard(GuardSettings settings) : settings_{settings} {}

  [[nodiscard]] Duration reaction_time() const { return settings_.reaction_time(); }
  /// Speed from which the vehicle stops within `distance_m` if the next map comes within
  /// `latency_bound`. Zero for a bound that is zero, negative or saturated (see `from_seconds`):
  /// such a bound says nothing about the next map.
  [[nodiscard]] double cruise_speed(Duration latency_bound, double distance_m) const;
  /// The test of each tick: v t_b + v^2 / (2 a) > d_now, so stop along the committed path.
  [[nodiscard]] bool must_brake(double speed_m_s, double known_free_now_m) const;
  [[nodiscard]] const GuardSettings& settings() const { return settings_; }

 private:
  GuardSettings settings_;
};

/// Upper bound on sensor-to-publish latency: the largest of the last 20, times 1.1; until there is
/// a sample, the seed. Allocates nothing.
class LatencyWindow {
 public:
  explicit LatencyWindow(Duration seed) : seed_{seed} {}
  void add(Duration latency);
  [[nodiscard]] Duration bound() const;

 private:
  Duration seed_;
  std::array<Duration, 20> recent_{};
  std::size_t added_{};  ///< Ever: the next one takes the place of the oldest.
};

}  // namespace flyball
