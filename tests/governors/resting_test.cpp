// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/resting.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Observation seen_at(double t_s, MissionPhase phase, std::uint64_t maps = 0) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.phase = phase;
  seen.map_revision = maps;
  return seen;
}

TEST(Resting, begins_when_the_vehicle_has_waited_for_a_moment) {
  Resting resting{1.5};
  EXPECT_FALSE(resting.allowed_s(seen_at(0.0, MissionPhase::wait)));
  EXPECT_FALSE(resting.allowed_s(seen_at(0.5, MissionPhase::wait)));
  EXPECT_EQ(resting.allowed_s(seen_at(1.0, MissionPhase::wait)), 1.5);
  EXPECT_FALSE(resting.allowed_s(seen_at(1.25, MissionPhase::take_off)));
  EXPECT_FALSE(resting.allowed_s(seen_at(1.5, MissionPhase::wait))) << "it waits anew";
}

TEST(Resting, flight_by_a_map_is_none) {
  Resting resting{1.5};
  for (double t_s = 0.0; t_s < 10.0; t_s += 0.5) {
    Observation seen = seen_at(t_s, MissionPhase::cruise, 7);
    seen.known_free_m = 20.0;
    EXPECT_FALSE(resting.allowed_s(seen)) << t_s;
  }
}

TEST(Resting, nor_is_a_flight_whose_first_map_is_late) {
  Resting resting{1.5};
  for (double t_s = 0.0; t_s < 10.0; t_s += 0.5) {
    Observation seen = seen_at(t_s, MissionPhase::cruise);
    seen.known_free_m = 1.0;  // What is declared free where it took off.
    EXPECT_FALSE(resting.allowed_s(seen)) << t_s;
  }
}

TEST(Resting, in_space_that_is_declared_free_nothing_waits_for_a_map) {
  Resting resting{1.5};
  Observation seen = seen_at(3.0, MissionPhase::cruise);
  seen.known_free_m = 80.0;
  EXPECT_FALSE(resting.allowed_s(seen));
  seen.now += from_seconds(1.0);
  EXPECT_TRUE(std::isinf(resting.allowed_s(seen).value_or(0.0)));
}

TEST(Resting, lasts_until_the_landing_of_a_flight_without_a_map_and_no_other) {
  for (const std::uint64_t maps : {std::uint64_t{0}, std::uint64_t{5}}) {
    Resting resting{1.5};
    (void)resting.allowed_s(seen_at(0.0, MissionPhase::land, maps));
    EXPECT_EQ(resting.allowed_s(seen_at(2.0, MissionPhase::land, maps)).has_value(), maps == 0);
  }
}

TEST(Resting, a_missed_deadline_raises_the_clock_until_it_ends) {
  Resting resting{1.0};
  (void)resting.allowed_s(seen_at(0.0, MissionPhase::wait));
  Observation late = seen_at(2.0, MissionPhase::wait);
  late.deadline_misses = 3;
  EXPECT_TRUE(resting.allowed_s(late));
  EXPECT_EQ(resting.raised_by(), 1U);
  EXPECT_TRUE(resting.allowed_s(seen_at(2.5, MissionPhase::wait)));
  EXPECT_EQ(resting.raised_by(), 1U);
  (void)resting.allowed_s(seen_at(3.0, MissionPhase::take_off));
  EXPECT_EQ(resting.raised_by(), 0U);
}

}  // namespace
}  // namespace flyball
