// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/idle.h"

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

TEST(Idle, begins_when_the_vehicle_has_waited_for_a_moment) {
  Idle idle{1.5};
  EXPECT_FALSE(idle.allowed_s(seen_at(0.0, MissionPhase::wait)));
  EXPECT_FALSE(idle.allowed_s(seen_at(0.5, MissionPhase::wait)));
  EXPECT_EQ(idle.allowed_s(seen_at(1.0, MissionPhase::wait)), 1.5);
  EXPECT_FALSE(idle.allowed_s(seen_at(1.25, MissionPhase::take_off)));
  EXPECT_FALSE(idle.allowed_s(seen_at(1.5, MissionPhase::wait))) << "it waits anew";
}

TEST(Idle, a_mission_may_say_how_long_a_map_may_take) {
  Idle idle{1.5};
  Observation seen = seen_at(0.0, MissionPhase::wait);
  seen.map_within = std::chrono::seconds{2};
  (void)idle.allowed_s(seen);
  seen.now += std::chrono::seconds{1};
  EXPECT_EQ(idle.allowed_s(seen), 2.0);
}

TEST(Idle, flight_by_a_map_is_none) {
  Idle idle{1.5};
  for (double t_s = 0.0; t_s < 10.0; t_s += 0.5) {
    Observation seen = seen_at(t_s, MissionPhase::cruise, 7);
    seen.known_free_m = 20.0;
    EXPECT_FALSE(idle.allowed_s(seen)) << t_s;
  }
}

TEST(Idle, nor_is_a_flight_whose_first_map_is_late) {
  Idle idle{1.5};
  for (double t_s = 0.0; t_s < 10.0; t_s += 0.5) {
    Observation seen = seen_at(t_s, MissionPhase::cruise);
    seen.known_free_m = 1.0;  // What is declared free where it took off.
    EXPECT_FALSE(idle.allowed_s(seen)) << t_s;
  }
}

TEST(Idle, in_space_that_is_declared_free_nothing_waits_for_a_map) {
  Idle idle{1.5};
  Observation seen = seen_at(3.0, MissionPhase::cruise);
  seen.known_free_m = 80.0;
  EXPECT_FALSE(idle.allowed_s(seen));
  seen.now += from_seconds(1.0);
  EXPECT_TRUE(std::isinf(idle.allowed_s(seen).value_or(0.0)));
}

TEST(Idle, lasts_until_the_landing_of_a_flight_without_a_map_and_no_other) {
  for (const std::uint64_t maps : {std::uint64_t{0}, std::uint64_t{5}}) {
    Idle idle{1.5};
    (void)idle.allowed_s(seen_at(0.0, MissionPhase::land, maps));
    EXPECT_EQ(idle.allowed_s(seen_at(2.0, MissionPhase::land, maps)).has_value(), maps == 0);
  }
}

TEST(Idle, a_missed_deadline_raises_the_clock_until_it_ends) {
  Idle idle{1.0};
  (void)idle.allowed_s(seen_at(0.0, MissionPhase::wait));
  Observation late = seen_at(2.0, MissionPhase::wait);
  late.deadline_misses = 3;
  EXPECT_TRUE(idle.allowed_s(late));
  EXPECT_EQ(idle.raised_by(), 1U);
  EXPECT_TRUE(idle.allowed_s(seen_at(2.5, MissionPhase::wait)));
  EXPECT_EQ(idle.raised_by(), 1U);
  (void)idle.allowed_s(seen_at(3.0, MissionPhase::take_off));
  EXPECT_EQ(idle.raised_by(), 0U);
}

}  // namespace
}  // namespace flyball
