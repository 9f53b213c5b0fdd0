// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What one decision knows. Every field is measured or estimated on board, never the world's truth.

#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"

#include <cstdint>

namespace flyball {

/// `unset` is no phase of a flight. An observation must say what the vehicle does, because a policy
/// lowers the clock while lower latency would not make the vehicle faster.
enum class MissionPhase : std::uint8_t { take_off, cruise, land, wait, unset };

struct Observation {
  MissionTime now{};
  MissionPhase phase{MissionPhase::unset};
  double speed_m_s{};
  double known_free_m{};        ///< Along the committed path; 0 when there is none.
  double obstacle_density{};    ///< Share of .8 m columns around the vehicle that hold an obstacle,
                                ///< 0..1.
  double density_ahead{};       ///< The largest such density around the committed path, 4 to 12 m
                                ///< on from here.
  double nearest_obstacle_m{};  ///< In the map, from the body's centre; 20 when none is nearer.
  double distance_to_goal_m{};
  double tracking_error_m{};
  double speed_limit_m_s{};          ///< The mission's least, here and 20 m on.
  double map_resolution_m{};         ///< In force now.
  std::uint64_t map_revision{};      ///< Counts published maps; `latency` is the newest one's.
  Duration latency{};                ///< Newest sensor-to-command time.
  Duration latency_bound{};          ///< In force for the speed limit.
  std::uint32_t deadline_misses{};   ///< Since the last decision.
  std::uint32_t queue_drops{};       ///< Since the last decision.
  std::uint32_t planner_failures{};  ///< In a row.
  int cores{};
  Hertz frequency{};
  double busy_cores{};         ///< Mean since the last decision.
  double busiest_core_load{};  ///< Share of the time since the last decision in which the busiest
                               ///< core was busy, 0..1.
  Watts computer_power{};
  Watts rotor_power{};
  double battery_percent{};
  double max_deceleration_m_s2{};  ///< What the mission's safe speed counts on; a in eq. 2.
  double narrowest_gap_m{};  ///< Least width ahead: of the widest openings on 24 m towards the goal
                             ///< and twice the room on the nearer side of the path's next 8 m.
  double gap_distance_m{};   ///< How far ahead that is.
  double mean_gap_m{};       ///< Mean of the widest openings over the same stretch.
  double temperature_c{};    ///< Of the computer, where its clocks' limit is measured.
  double trip_c{};     ///< The lowest temperature at which it loses clocks; 0: nobody says, and the
                       ///< temperature says nothing either.
  Duration map_age{};  ///< Since the frame of the newest map was captured; 0: nobody says.
};

}  // namespace flyball
