// SPDX-License-Identifier: BSD-3-Clause
#include "mission_energy/passability.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

Passability four_levels() {
  PassabilitySettings settings;
  settings.body_m = 0.7;
  settings.least = 2s;
  settings.patience = 3s;
  settings.retry_m = 0.35;
  settings.near_m = 8.0;
  return {settings, {0.15, 0.30, 0.60, 1.20}};
}

Observation seen(double t_s, double gap_m, double resolution_m) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.phase = MissionPhase::cruise;
  seen.speed_m_s = 5.0;
  seen.narrowest_gap_m = gap_m;
  seen.gap_distance_m = 5.0;
  seen.nearest_obstacle_m = 20.0;
  seen.map_resolution_m = resolution_m;
  return seen;
}

TEST(Passability, is_coarsest_in_the_open) {
  EXPECT_EQ(four_levels().judge(seen(0.0, 24.0, 0.15)).coarsest_level, 3U);
}

TEST(Passability, asks_for_the_finest_cells_for_a_gap_that_is_shut) {
  EXPECT_EQ(four_levels().judge(seen(0.0, 0.3, 1.20)).coarsest_level, 0U);
  EXPECT_EQ(four_levels().judge(seen(0.0, 0.3, 0.15)).coarsest_level, 0U);
}

TEST(Passability, counts_on_what_coarser_cells_take_from_a_gap) {
  // 1.6 m in cells of .15 m: 1.3 m in .30, which is the body with a cell on each side.
  EXPECT_EQ(four_levels().judge(seen(0.0, 1.6, 0.15)).coarsest_level, 1U);
  EXPECT_EQ(four_levels().judge(seen(0.0, 1.59, 0.15)).coarsest_level, 0U);
  // 2.8 m: 1.9 m in .60, the same.
  EXPECT_EQ(four_levels().judge(seen(0.0, 2.8, 0.15)).coarsest_level, 2U);
  EXPECT_EQ(four_levels().judge(seen(0.0, 2.79, 0.15)).coarsest_level, 1U);
}

TEST(Passability, does_not_flutter_where_the_chosen_cells_narrow_the_gap) {
  Passability passability = four_levels();
  const double gap_m = 2.05;  // True width.
  double resolution_m = 0.15;
  const double levels_m[] = {0.15, 0.30, 0.60, 1.20};
  std::size_t before = passability.judge(seen(0.0, gap_m - 2.0 * 0.15, 0.15)).coarsest_level;
  for (double t_s = 5.0; t_s < 60.0; t_s += 5.0) {
    resolution_m = levels_m[before];
    const auto now = passability.judge(seen(t_s, gap_m - 2.0 * resolution_m, resolution_m));
    EXPECT_EQ(now.coarsest_level, before) << t_s;
    before = now.coarsest_level;
  }
  EXPECT_EQ(before, 1U);
}

TEST(Passability, becomes_finer_at_once_and_coarser_after_a_while) {
  Passability passability = four_levels();
  EXPECT_EQ(passability.judge(seen(0.0, 24.0, 1.20)).coarsest_level, 3U);
  EXPECT_EQ(passability.judge(seen(0.1, 0.0, 1.20)).coarsest_level, 0U);
  EXPECT_EQ(passability.judge(seen(2.0, 24.0, 0.15)).coarsest_level, 0U);
  EXPECT_EQ(passability.judge(seen(2.2, 24.0, 0.15)).coarsest_level, 3U);
}

TEST(Passability, becomes_coarser_only_when_obstacles_are_some_cells_away) {
  Passability passability = four_levels();
  (void)passability.judge(seen(0.0, 0.0, 1.20));
  Observation beside_a_wall = seen(10.0, 24.0, 0.15);
  beside_a_wall.nearest_obstacle_m = 0.9;
  EXPECT_EQ(passability.judge(beside_a_wall).coarsest_level, 0U);
  beside_a_wall.nearest_obstacle_m = 2.7;
  EXPECT_EQ(passability.judge(beside_a_wall).coarsest_level, 2U);
  beside_a_wall.nearest_obstacle_m = 2.8;
  EXPECT_EQ(passability.judge(beside_a_wall).coarsest_level, 3U);
}

TEST(Passability, asks_for_smaller_cells_after_a_failed_plan_and_for_the_finest_after_two) {
  Passability passability = four_levels();
  Observation failed = seen(0.0, 24.0, 0.60);
  failed.planner_failures = 1;
  EXPECT_EQ(passability.judge(failed).coarsest_level, 1U);
  failed.planner_failures = 2;
  EXPECT_EQ(passability.judge(failed).coarsest_level, 0U);
}

TEST(Passability, stands_without_haste_where_the_mission_waits) {
  Passability passability = four_levels();
  Observation waiting = seen(0.0, 24.0, 0.15);
  waiting.phase = MissionPhase::land;
  waiting.speed_m_s = 0.0;
  EXPECT_EQ(passability.judge(waiting).coarsest_level, 3U);
  waiting.now += 60s;
  EXPECT_EQ(passability.judge(waiting).coarsest_level, 3U);
}

TEST(Passability, allows_large_cells_among_obstacles_that_stand_apart_until_a_plan_fails) {
  Passability passability = four_levels();
  Observation seen_it = seen(0.0, 6.0, 1.20);
  seen_it.obstacle_density = seen_it.density_ahead = 0.2;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 3U);
  seen_it.planner_failures = 1;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 1U);
}

TEST(Passability, wants_a_cell_of_room_on_each_side_of_the_body) {
  Observation seen_it = seen(0.0, 0.7 + 2.0 * 0.30, 0.30);
  seen_it.gap_distance_m = 5.0;
  EXPECT_EQ(four_levels().judge(seen_it).coarsest_level, 1U);
  seen_it.narrowest_gap_m -= 0.01;
  EXPECT_EQ(four_levels().judge(seen_it).coarsest_level, 0U);
  seen_it.narrowest_gap_m = 0.7 + 2.0 * 0.60;
  seen_it.map_resolution_m = 1.20;  // Finer cells than the map's show no less.
  EXPECT_EQ(four_levels().judge(seen_it).coarsest_level, 2U);
}

TEST(Passability, looks_at_a_far_gap_with_the_next_cells_and_at_a_near_one_with_the_finest) {
  Passability passability = four_levels();
  Observation seen_it = seen(0.0, 0.3, 0.60);
  seen_it.gap_distance_m = 12.0;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 1U);
  seen_it.gap_distance_m = 7.0;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U);
}

TEST(Passability, needs_finest_cells_until_it_is_past_the_gap_though_they_do_not_show_it_yet) {
  Passability passability = four_levels();
  Observation seen_it = seen(0.0, 0.3, 0.30);
  seen_it.gap_distance_m = 6.0;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U);
  seen_it = seen(2.0, 24.0, 0.15);  // Nothing of the wall is in the new map.
  seen_it.speed_m_s = 2.5;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U);
  seen_it.now += 1400ms;  // 8.5 m on.
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U);
  seen_it.now += 400ms;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 3U);
}

TEST(Passability, needs_no_cells_for_a_gap_before_there_is_a_map) {
  Passability passability = four_levels();
  Observation before = seen(0.0, 24.0, 0.0);
  before.gap_distance_m = before.speed_m_s = 0.0;
  EXPECT_EQ(passability.judge(before).coarsest_level, 0U) << "nothing is known";
  before.now += 2s;
  before.map_resolution_m = 0.15;
  EXPECT_EQ(passability.judge(before).coarsest_level, 3U);
}

TEST(Passability, forgets_a_gap_that_finest_cells_do_not_show_where_it_was) {
  Passability passability = four_levels();
  Observation seen_it = seen(0.0, 0.3, 0.30);
  seen_it.gap_distance_m = 8.0;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U);
  seen_it = seen(0.5, 24.0, 0.15);
  seen_it.speed_m_s = 1.0;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U);
  seen_it.now += 2s;  // Still 10 m to what is behind it.
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 0U) << "too far off to be seen";
  seen_it.now += 2s;
  EXPECT_EQ(passability.judge(seen_it).coarsest_level, 3U);
}

TEST(Passability, does_not_turn_to_finest_cells_at_once_for_what_they_do_not_reach) {
  Passability passability = four_levels();
  Observation failed = seen(0.0, 0.3, 0.30);
  failed.gap_distance_m = 12.0;
  failed.planner_failures = 1;
  EXPECT_EQ(passability.judge(failed).coarsest_level, 1U);
  failed.gap_distance_m = 4.0;
  EXPECT_EQ(passability.judge(failed).coarsest_level, 0U) << "now they do";
}

TEST(Passability, looks_farther_before_it_would_stand_for_ever) {
  Passability passability = four_levels();
  Observation standing = seen(0.0, 24.0, 0.30);
  standing.gap_distance_m = 12.0;
  standing.speed_m_s = 0.0;
  EXPECT_EQ(passability.judge(standing).coarsest_level, 3U);
  standing.now += 3s;
  EXPECT_EQ(passability.judge(standing).coarsest_level, 1U);
  standing.now += 8s;
  EXPECT_EQ(passability.judge(standing).look_m, 0.0);
  standing.now += 1s;
  EXPECT_EQ(passability.judge(standing).look_m, 15.0);
  EXPECT_EQ(passability.judge(standing).coarsest_level, 0U);
  standing.speed_m_s = 1.0;
  EXPECT_EQ(passability.judge(standing).look_m, 0.0);
}

TEST(Passability, takes_what_is_no_number_for_a_narrow_gap) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(four_levels().judge(seen(0.0, nothing, 0.15)).coarsest_level, 0U);
  EXPECT_EQ(four_levels().judge(seen(0.0, 24.0, nothing)).coarsest_level, 0U);
}

}  // namespace
}  // namespace flyball
