// SPDX-License-Identifier: BSD-3-Clause
#include "time_budget.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <array>

namespace flyball {

double StoppingDistance::distance_m(double speed_m_s) const {
  return (quadratic_s2_m * speed_m_s + linear_s) * speed_m_s + constant_m;
}

StoppingDistance StoppingDistance::braking(double deceleration_m_s2) {
  FLYBALL_ASSERT(deceleration_m_s2 > 0.0, "deceleration_m_s2=%g", deceleration_m_s2);
  return {1.0 / (2.0 * deceleration_m_s2), 0.0, 0.0};
}

StoppingDistance StoppingDistance::roborun() {
  return {0.05494, 0.3549, -0.2038};
}

double TimeBudget::budget_s(double speed_m_s, double known_free_m) const {
  FLYBALL_ASSERT(speed_m_s >= 0.0, "speed_m_s=%g", speed_m_s);
  const double room_m = known_free_m - stop.distance_m(speed_m_s);
  if (room_m <= 0.0) {
    return 0.0;
  }
  // Compared before the division, which at rest would be by zero.
  return share * room_m >= cap_s * speed_m_s ? cap_s : share * room_m / speed_m_s;
}

double rolled_budget_s(const double* local_s, std::size_t count, double step_s) {
  if (count == 0) {
    return 0.0;
  }
  double flown_s = 0.0;
  double left_s = local_s[0];
  for (std::size_t i = 1; i < count; ++i) {
    if (left_s <= step_s) {
      return flown_s + left_s;
    }
    flown_s += step_s;
    left_s = std::min(left_s - step_s, std::max(0.0, local_s[i]));
  }
  return flown_s + left_s;
}

double budget_ahead_s(const TimeBudget& budget, const SpeedingUp& trajectory, double known_free_m) {
  constexpr double step_s = 0.2;  // Of RoboRun's trajectories.
  std::array<double, 512> local_s{};
  TimeBudget whole = budget;
  whole.share = 1.0;
  double ahead_m = 0.0;
  std::size_t count = 0;
  while (count < local_s.size() && ahead_m <= known_free_m) {
    const double reached_m_s = trajectory.acceleration_m_s2 > 0.0
                                   ? trajectory.speed_m_s + trajectory.acceleration_m_s2 * step_s *
                                                                static_cast<double>(count)
                                   : trajectory.commanded_m_s;
    const double speed_m_s = std::min(reached_m_s, trajectory.commanded_m_s);
    local_s[count++] = whole.budget_s(speed_m_s, known_free_m - ahead_m);
    ahead_m += speed_m_s * step_s;
  }
  return budget.share * std::min(budget.cap_s, rolled_budget_s(local_s.data(), count, step_s));
}

}  // namespace flyball
