// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_worth.h"

namespace flyball {

double watts_per_second(double deceleration_m_s2,
                        double response_s,
                        double speed_m_s,
                        double power_w,
                        double slope_w_s_m) {
  return speed_m_s > 0.0
             ? (power_w - speed_m_s * slope_w_s_m) / (response_s + speed_m_s / deceleration_m_s2)
             : 0.0;
}

}  // namespace flyball
