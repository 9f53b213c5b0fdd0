// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/speed_limit.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/guard.h"

#include <algorithm>

namespace flyball {

double SpeedLimit::speed_m_s(double latency_s, double distance_m) const {
  return safe_speed(deceleration_m_s2, latency_s, distance_m);
}

double SpeedLimit::latency_s(double speed_m_s, double distance_m) const {
  FLYBALL_ASSERT(speed_m_s > 0.0, "speed_m_s=%g", speed_m_s);
  return std::max(0.0, distance_m / speed_m_s - speed_m_s / (2.0 * deceleration_m_s2));
}

double SpeedLimit::distance_m(double speed_m_s, double latency_s) const {
  return speed_m_s * latency_s + speed_m_s * speed_m_s / (2.0 * deceleration_m_s2);
}

double SpeedLimit::speed_per_latency_m_s2(double latency_s, double distance_m) const {
  const double v = speed_m_s(latency_s, distance_m);
  return v > 0.0 ? -v / (latency_s + v / deceleration_m_s2) : 0.0;
}

double SpeedLimit::speed_per_distance_1_s(double latency_s, double distance_m) const {
  FLYBALL_ASSERT(distance_m > 0.0, "distance_m=%g", distance_m);
  return 1.0 / (latency_s + speed_m_s(latency_s, distance_m) / deceleration_m_s2);
}

double SpeedLimit::watts_per_second(double power_w,
                                    double latency_s,
                                    double distance_m,
                                    double slope_w_s_m) const {
  const double v = speed_m_s(latency_s, distance_m);
  return v > 0.0 ? (power_w - v * slope_w_s_m) / (latency_s + v / deceleration_m_s2) : 0.0;
}

}  // namespace flyball
