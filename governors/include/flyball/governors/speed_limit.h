// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What latency costs in speed, and so in power.

namespace flyball {

/// The largest speed from which a vehicle stops within d after reacting for delta; MAVBench
/// (MICRO 2018) eq. 2. All of it follows from one equation of motion, d = v delta + v^2 / (2 a):
///
///     v         = a (sqrt(delta^2 + 2 d / a) - delta)       solved for v > 0: eq. 2
///     delta     = d / v - v / (2 a)                         solved for delta
///     dv/ddelta = -v / (delta + v / a)                      differentiated at constant d
///     dv/dd     = 1 / (delta + v / a)                       differentiated at constant delta
///
/// @pre Everywhere: `deceleration_m_s2 > 0`, `latency_s >= 0`.
struct SpeedLimit {
  double deceleration_m_s2{6.0};  ///< a; 6 is MAVBench's.

  /// Zero for no distance.
  [[nodiscard]] double speed_m_s(double latency_s, double distance_m) const;
  /// The largest latency with which `speed_m_s` is still safe; zero when none is.
  /// @pre `speed_m_s > 0`.
  [[nodiscard]] double latency_s(double speed_m_s, double distance_m) const;
  /// The distance that this speed needs.
  [[nodiscard]] double distance_m(double speed_m_s, double latency_s) const;
  /// dv/ddelta [m/s^2], never positive; zero where there is no distance.
  [[nodiscard]] double speed_per_latency_m_s2(double latency_s, double distance_m) const;
  /// dv/dd [1/s]. @pre `distance_m > 0`.
  [[nodiscard]] double speed_per_distance_1_s(double latency_s, double distance_m) const;

  /// What one second of latency is worth [W/s]: with J = P(v) / v joules per metre, the power that
  /// may be spent to shorten delta by ddelta without loss is
  ///
  ///     v dJ/ddelta = (P - v dP/dv) / (delta + v / a)
  ///
  /// @param slope_w_s_m  dP/dv [W s/m].
  /// Worth nothing where something else than latency limits the speed: the caller knows.
  [[nodiscard]] double watts_per_second(double power_w,
                                        double latency_s,
                                        double distance_m,
                                        double slope_w_s_m = 0.0) const;
};

}  // namespace flyball
