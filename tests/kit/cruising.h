// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a policy sees in the open.

#include "flyball/governors/policy.h"

#include <chrono>

namespace flyball::kit {

inline constexpr double top_hz = 2035.2e6;

/// In the open, at full speed.
inline Observation cruising() {
  Observation seen;
  seen.now = MissionTime{std::chrono::seconds{10}};
  seen.phase = MissionPhase::cruise;
  seen.speed_m_s = seen.speed_limit_m_s = 6.0;
  seen.max_deceleration_m_s2 = 3.0;
  seen.known_free_m = 25.0;
  seen.narrowest_gap_m = seen.gap_distance_m = seen.mean_gap_m = 24.0;
  seen.nearest_obstacle_m = 20.0;
  seen.distance_to_goal_m = 200.0;
  seen.map_resolution_m = 0.30;
  seen.map_revision = 1;  // Without a map it would rest.
  seen.latency = std::chrono::milliseconds{200};
  seen.cores = 4;
  seen.frequency = Hertz{top_hz};
  seen.busy_cores = 2.0;
  return seen;
}

}  // namespace flyball::kit
