// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/search_space.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(SearchSpace, latencies_lie_on_a_line_between_the_two_that_are_known) {
  const auto levels = levels_between({0.15, 0.30, 0.60}, 0.8, 0.2);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_DOUBLE_EQ(levels[0].latency_s, 0.8);
  EXPECT_NEAR(levels[1].latency_s, 0.4, 1e-12);  // Their geometric mean.
  EXPECT_DOUBLE_EQ(levels[2].latency_s, 0.2);
  EXPECT_NEAR(levels[1].range_slope, 0.5 * (levels[0].range_slope + levels[2].range_slope), 1e-12);
  EXPECT_GT(levels[0].range_slope, levels[2].range_slope);
}

TEST(SearchSpace, a_single_level_has_the_fine_latency) {
  const auto levels = levels_between({0.3}, 0.8, 0.2);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_DOUBLE_EQ(levels[0].latency_s, 0.8);
}

TEST(SearchSpace, ranges_are_equal_steps_in_proportion) {
  const auto ranges_m = ranges_between(7.0, 25.0);
  ASSERT_EQ(ranges_m.size(), 5U);
  EXPECT_EQ(ranges_m.front(), 7.0);
  EXPECT_EQ(ranges_m.back(), 25.0);
  for (std::size_t i = 2; i < ranges_m.size(); ++i) {
    EXPECT_NEAR(ranges_m[i] / ranges_m[i - 1], ranges_m[1] / ranges_m[0], 1e-12);
  }
}

TEST(SearchSpace, the_missions_own_limits_count_where_they_make_sense) {
  Observation seen;
  seen.speed_limit_m_s = 4.0;
  seen.max_deceleration_m_s2 = 3.0;
  EXPECT_EQ(limits_of(seen).speed_limit_m_s, 4.0);
  EXPECT_EQ(limits_of(seen).deceleration_m_s2, 3.0);
  for (const double nonsense : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    seen.speed_limit_m_s = seen.max_deceleration_m_s2 = nonsense;
    EXPECT_EQ(limits_of(seen).speed_limit_m_s, 10.0) << nonsense;
    EXPECT_EQ(limits_of(seen).deceleration_m_s2, 6.0) << nonsense;
  }
}

TEST(SearchSpace, in_the_open_a_vehicle_is_slow_because_of_latency_alone) {
  Observation seen;
  seen.phase = MissionPhase::cruise;
  seen.speed_limit_m_s = 4.0;
  seen.speed_m_s = 2.0;
  seen.narrowest_gap_m = open_path_m;
  EXPECT_FALSE(is_held_up(seen));
  Observation at_a_gap = seen;
  at_a_gap.narrowest_gap_m = 2.0;
  EXPECT_TRUE(is_held_up(at_a_gap));
  at_a_gap.speed_m_s = 4.0;
  EXPECT_FALSE(is_held_up(at_a_gap)) << "it could not be faster";
  Observation after_a_failed_plan = seen;
  after_a_failed_plan.planner_failures = 1;
  EXPECT_TRUE(is_held_up(after_a_failed_plan));
  Observation lands = seen;
  lands.phase = MissionPhase::land;
  EXPECT_TRUE(is_held_up(lands));
  for (const double standing_m_s : {0.0, 0.05, std::numeric_limits<double>::quiet_NaN()}) {
    Observation stands = seen;
    stands.speed_m_s = standing_m_s;
    EXPECT_TRUE(is_held_up(stands)) << standing_m_s;
  }
}

TEST(SearchSpace, what_was_shown_free_counts_from_where_the_frame_was_taken) {
  Observation seen;
  seen.known_free_m = 3.0;
  seen.speed_m_s = 2.0;
  seen.latency = from_seconds(0.25);
  EXPECT_NEAR(shown_free_m(seen), 3.5, 1e-9);
  seen.known_free_m = 0.0;
  seen.speed_m_s = 0.0;
  EXPECT_EQ(shown_free_m(seen), 0.0);
}

TEST(SearchSpace, nonsense_shows_nothing_free) {
  Observation seen;
  for (const double nonsense : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    seen.known_free_m = nonsense;
    EXPECT_EQ(shown_free_m(seen), 0.0) << nonsense;
  }
}

TEST(SearchSpace, options_are_what_is_allowed_the_cheapest_first) {
  EnergyEstimate dear;
  dear.setting = {0.15, 7.0, 2e9};
  dear.joules_per_m = 90.0;
  dear.speed_m_s = 3.0;
  EnergyEstimate cheap = dear;
  cheap.setting.resolution_m = 0.6;
  cheap.joules_per_m = 70.0;
  EnergyEstimate shut = dear;
  shut.joules_per_m = std::numeric_limits<double>::infinity();
  const auto options = options_of({dear, shut, cheap});
  ASSERT_EQ(options.size(), 2U);
  EXPECT_EQ(options[0].joules_per_m, 70.0);
  EXPECT_EQ(options[0].setting.begin()->value, 0.6);
  EXPECT_EQ(options[1].joules_per_m, 90.0);
  EXPECT_EQ(options[1].speed_m_s, 3.0);
}

}  // namespace
}  // namespace flyball
