// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/surroundings.h"

#include "flyball/governors/waiting_share.h"

#include <algorithm>
#include <cmath>

namespace flyball {

Surroundings surroundings_of(const Observation& seen) {
  // The defaults of a mission (MissionSettings).
  constexpr double usual_m_s = 10.0;
  constexpr double usual_m_s2 = 6.0;
  const double limit_m_s = seen.speed_limit_m_s;
  const double brakes_m_s2 = seen.max_deceleration_m_s2;
  Surroundings around;
  around.speed_limit_m_s =
      std::isfinite(limit_m_s) && limit_m_s > 0.0 ? std::min(limit_m_s, 100.0) : usual_m_s;
  around.deceleration_m_s2 = brakes_m_s2 > 0.1 && brakes_m_s2 < 100.0 ? brakes_m_s2 : usual_m_s2;
  around.visibility_m = shown_free_m(seen);
  return around;
}

double shown_free_m(const Observation& seen) {
  constexpr double farthest_m = 1e6;
  const double flown_m = seen.speed_m_s * std::max(0.0, to_seconds(seen.latency));
  const double shown_m = seen.known_free_m + std::max(0.0, flown_m);
  return std::isfinite(shown_m) ? std::clamp(shown_m, 0.0, farthest_m) : 0.0;
}

bool is_held_up(const Observation& seen) {
  constexpr double nearly = 0.9;  // The reference approaches its limit gradually.
  if (seen.phase != MissionPhase::cruise || stands_in_cruise(seen)) {
    return true;
  }
  const bool is_free = seen.planner_failures == 0 && seen.narrowest_gap_m >= open_path_m;
  return !is_free && seen.speed_m_s < nearly * surroundings_of(seen).speed_limit_m_s;
}

}  // namespace flyball
