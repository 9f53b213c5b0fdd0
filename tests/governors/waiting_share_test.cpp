// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/waiting_share.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// So many seconds of cruise at this speed, from `begin_s` on.
void fly(WaitingShare& waiting, double begin_s, double seconds, double speed_m_s) {
  for (int i = 0; i <= static_cast<int>(4.0 * seconds); ++i) {
    Observation seen;
    seen.phase = MissionPhase::cruise;
    seen.now = MissionTime{from_seconds(begin_s + 0.25 * i)};
    seen.speed_m_s = speed_m_s;
    waiting.note(seen);
  }
}

TEST(WaitingShare, stands_in_cruise_who_does_not_surely_move) {
  Observation seen;
  seen.phase = MissionPhase::cruise;
  for (const double standing_m_s : {0.0, 0.1, std::nan("")}) {
    seen.speed_m_s = standing_m_s;
    EXPECT_TRUE(stands_in_cruise(seen)) << standing_m_s;
  }
  seen.phase = MissionPhase::wait;
  EXPECT_FALSE(stands_in_cruise(seen));
  seen.phase = MissionPhase::cruise;
  seen.speed_m_s = 0.2;
  EXPECT_FALSE(stands_in_cruise(seen));
}

TEST(WaitingShare, follows_the_exponential_of_one_minute) {
  WaitingShare waiting;
  EXPECT_EQ(waiting.share(), 0.0);
  fly(waiting, 0.0, 30.0, 0.0);
  const double stood = 1.0 - std::exp(-0.5);
  EXPECT_NEAR(waiting.share(), stood, 1e-9);
  fly(waiting, 30.0, 60.0, 1.0);
  EXPECT_NEAR(waiting.share(), stood * std::exp(-1.0), 1e-9);
}

TEST(WaitingShare, counts_cruise_only) {
  WaitingShare waiting;
  Observation seen;
  seen.phase = MissionPhase::wait;
  for (int i = 0; i < 400; ++i) {
    seen.now += from_seconds(0.25);
    waiting.note(seen);
  }
  EXPECT_EQ(waiting.share(), 0.0);
  seen.phase = MissionPhase::cruise;  // The time before is no time of cruise.
  waiting.note(seen);
  EXPECT_EQ(waiting.share(), 0.0);
}

TEST(WaitingShare, a_speed_that_is_no_number_counts_as_standing) {
  WaitingShare waiting;
  fly(waiting, 0.0, 60.0, std::nan(""));
  EXPECT_NEAR(waiting.share(), 1.0 - std::exp(-1.0), 1e-9);
}

TEST(WaitingShare, half_the_clock_doubles_what_is_waited) {
  WaitingShare waiting;
  EXPECT_EQ(waiting.delay(1e9, 2e9), 1.0);
  fly(waiting, 0.0, 600.0, 0.0);
  EXPECT_NEAR(waiting.delay(1e9, 2e9), 2.0, 1e-4);
  EXPECT_EQ(waiting.delay(2e9, 2e9), 1.0);
}

}  // namespace
}  // namespace flyball
