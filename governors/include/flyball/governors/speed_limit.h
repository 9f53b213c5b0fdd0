// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What latency costs in speed, and so in power.

namespace flyball {

/// The largest speed from which a vehicle stops within d after reacting for delta; MAVBench
/// (MICRO 2018) eq. 2. All of it follows from one equation of motion, d = v delta + v^2 / (2 a):
///
///     v         = a (sqrt(delta^2 + 2 d / a) - delta)       solved for v > 0: eq. 2
///     dv/ddelta = -v / (delta + v / a)                      differentiated at constant d
///
/// @pre Everywhere: `deceleration_m_s2 > 0`, `latency_s >= 0`.
struct SpeedLimit {
  double deceleration_m_s2{6.0};  ///< a; 6 is MAVBench's.

  /// Zero for no distance.
  [[nodiscard]] double speed_m_s(double latency_s, double distance_m) const;

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
