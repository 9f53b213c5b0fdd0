// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What latency costs in speed, and so in power.

namespace flyball {

/// What one second of response time is worth [W/s]. A vehicle flies at most so fast that it stops
/// within d after reacting for delta, d = v delta + v^2 / (2 a); solved for v, that is MAVBench's
/// eq. 2 (MICRO 2018; `safe_speed`), and differentiated at constant d
///
///     dv/ddelta = -v / (delta + v / a)
///
/// With J = P(v) / v joules per metre, the power that may be spent to shorten delta by ddelta
/// without loss is then
///
///     v dJ/ddelta = (P - v dP/dv) / (delta + v / a)
///
/// It is worth nothing where something else than latency limits the speed: the caller knows.
/// @param speed_m_s    v. Nothing is worth anything at 0.
/// @param slope_w_s_m  dP/dv [W s/m].
/// @pre `deceleration_m_s2 > 0`, `response_s >= 0`.
[[nodiscard]] double watts_per_second(double deceleration_m_s2,
                                      double response_s,
                                      double speed_m_s,
                                      double power_w,
                                      double slope_w_s_m);

}  // namespace flyball
