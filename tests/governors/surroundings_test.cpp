// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/surroundings.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Surroundings, the_missions_own_limits_count_where_they_make_sense) {
  Observation seen;
  seen.speed_limit_m_s = 4.0;
  seen.max_deceleration_m_s2 = 3.0;
  EXPECT_EQ(surroundings_of(seen).speed_limit_m_s, 4.0);
  EXPECT_EQ(surroundings_of(seen).deceleration_m_s2, 3.0);
  for (const double nonsense : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    seen.speed_limit_m_s = seen.max_deceleration_m_s2 = nonsense;
    EXPECT_EQ(surroundings_of(seen).speed_limit_m_s, 10.0) << nonsense;
    EXPECT_EQ(surroundings_of(seen).deceleration_m_s2, 6.0) << nonsense;
  }
}

TEST(Surroundings, in_the_open_a_vehicle_is_slow_because_of_latency_alone) {
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

TEST(Surroundings, what_was_shown_free_counts_from_where_the_frame_was_taken) {
  Observation seen;
  seen.known_free_m = 3.0;
  seen.speed_m_s = 2.0;
  seen.latency = from_seconds(0.25);
  EXPECT_NEAR(shown_free_m(seen), 3.5, 1e-9);
  EXPECT_EQ(surroundings_of(seen).visibility_m, shown_free_m(seen));
  seen.known_free_m = 0.0;
  seen.speed_m_s = 0.0;
  EXPECT_EQ(shown_free_m(seen), 0.0);
}

TEST(Surroundings, nonsense_shows_nothing_free) {
  Observation seen;
  for (const double nonsense : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    seen.known_free_m = nonsense;
    EXPECT_EQ(shown_free_m(seen), 0.0) << nonsense;
  }
}

}  // namespace
}  // namespace flyball
