// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/speed_limit.h"

#include "flyball/runtime/guard.h"

namespace flyball {

double SpeedLimit::speed_m_s(double latency_s, double distance_m) const {
  return safe_speed(deceleration_m_s2, latency_s, distance_m);
}

double SpeedLimit::watts_per_second(double power_w,
                                    double latency_s,
                                    double distance_m,
                                    double slope_w_s_m) const {
  const double v = speed_m_s(latency_s, distance_m);
  return v > 0.0 ? (power_w - v * slope_w_s_m) / (latency_s + v / deceleration_m_s2) : 0.0;
}

}  // namespace flyball
