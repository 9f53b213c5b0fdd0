// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What one decision knows. Every field is measured or estimated on board, never the world's truth.

#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace flyball {

/// `unset` is no phase of a flight. An observation must say what the vehicle does, because a policy
/// lowers the clock while lower latency would not make the vehicle faster.
enum class MissionPhase : std::uint8_t { take_off, cruise, land, wait, unset };

/// In what a mission counts its progress. `none`: it does not say.
enum class ProgressUnit : std::uint8_t { none, metre, square_metre, cubic_metre, second };

/// Stages of the computation that have knobs, or cost much. `localize` is that of camera images.
enum class Stage : std::uint8_t { map, plan, detect, track, localize, explore };
inline constexpr std::size_t stage_count = 6;

/// What a stage takes of the computer. All are 0 where there is no such stage, or nobody measures.
struct StageUse {
  Duration latency{};   ///< Of its newest job, from its trigger to its result.
  double load{};        ///< Cores that it kept busy since the last decision. A job counts when it
                        ///< ends, so after a long one this may be more than there are.
  double gigacycles{};  ///< Clock cycles of its newest job, in 10^9: its work, whatever the clock.
};

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
  double speed_limit_m_s{};      ///< The mission's least, here and 20 m on.
  double map_resolution_m{};     ///< Of the newest map.
  std::uint64_t map_revision{};  ///< Counts published maps; `latency` is the newest one's.
  Duration latency{};            ///< Of the newest map, from sensor to published map.
  /// The map age that the speed limit counts with: a map's latency, the time until the next map and
  /// the reckoning of the localizer, each at its bound (`MapLatency::age_bound`). So it is more
  /// than a bound on `latency` alone. The C library bounds the latency of a frame here.
  Duration latency_bound{};
  std::uint32_t deadline_misses{};  ///< Since the last decision.
  std::uint32_t queue_drops{};      ///< Since the last decision.
  /// Searches without a path since one was found, and stalls since the vehicle last moved.
  std::uint32_t planner_failures{};
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
                             ///< and of the passage that the path's next 8 m lead through, 6
                             ///< where nothing is within 3 m of the path.
  double gap_distance_m{};   ///< How far ahead that is.
  double mean_gap_m{};       ///< Mean of the widest openings over the same stretch.
  double temperature_c{};    ///< Of the computer, where its clocks' limit is measured.
  double trip_c{};     ///< The lowest temperature at which it loses clocks; 0: nobody says, and the
                       ///< temperature says nothing either.
  Duration map_age{};  ///< Since the frame of the newest map was captured; 0: nobody says.
  double headroom_m{};  ///< From the top of the body up to an obstacle in the map, at most 5; 0:
                        ///< nobody says.
  ProgressUnit progress_unit{};
  double progress{};  ///< Since take-off, in this unit, as far as the vehicle itself can tell.
  Watts cpu_power{};  ///< Of the processors' rail; these four are 0 where the board has no such
  Watts gpu_power{};  ///< meter, and they are in `computer_power` too.
  Watts memory_power{};
  Watts soc_power{};       ///< Of the rest of the chip.
  Duration map_within{};   ///< While the vehicle waits: how soon after a map the mission needs the
                           ///< next one; 0: nobody says.
  double slower_zone_m{};  ///< To the nearest zone where the mission's speed limit is lower than
                           ///< here, at most 40; 0: nobody says.
  double map_range_m{};    ///< Of the newest frame in the newest map; 0: nobody says.
  std::array<StageUse, stage_count> stages{};

  [[nodiscard]] const StageUse& stage(Stage one) const {
    return stages[static_cast<std::size_t>(one)];
  }
  [[nodiscard]] StageUse& stage(Stage one) { return stages[static_cast<std::size_t>(one)]; }
};

}  // namespace flyball
