// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/fallback_ladder.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A quarter of a second after the last one, a new map each time.
class Looking {
 public:
  explicit Looking(const FallbackSettings& settings = {}) : ladder{settings} {
    seen.phase = MissionPhase::cruise;
    seen.latency = 100ms;
    seen.latency_bound = 200ms;
    seen.frequency = Hertz{2e9};
    seen.cores = 4;
    request = {2e9, 4.0};
  }
  Fallback next() {
    seen.now += 250ms;
    ++seen.map_revision;
    return ladder.look(seen, request);
  }
  FallbackLadder ladder;
  Observation seen{};
  FallbackLadder::Request request{};
};

TEST(FallbackLadder, stays_down_while_nothing_is_wrong) {
  Looking looking;
  for (int i = 0; i < 100; ++i) {
    looking.seen.deadline_misses = i % 2;  // Two a second are drained.
    EXPECT_EQ(Fallback::none, looking.next());
    EXPECT_EQ("", looking.ladder.why());
  }
}

TEST(FallbackLadder, takes_a_phase_that_was_never_set_for_a_mistake) {
  for (const bool enabled : {true, false}) {
    FallbackSettings settings;
    settings.enabled = enabled;
    Looking looking{settings};
    looking.seen.phase = Observation{}.phase;
    EXPECT_EQ(Fallback::table, looking.next());
    EXPECT_EQ(
        "the observation's phase was never set; set it to what the vehicle does, such as "
        "cruise",
        looking.ladder.why());
    looking.seen.phase = MissionPhase::wait;
    EXPECT_EQ(Fallback::none, looking.next());
  }
}

TEST(FallbackLadder, widens_the_bound_when_maps_are_late_until_none_of_the_window_was) {
  Looking looking;
  static_cast<void>(looking.next());
  looking.seen.latency = 300ms;
  EXPECT_EQ(Fallback::none, looking.next()) << "one may be late";
  EXPECT_EQ(Fallback::wide_bound, looking.next());
  EXPECT_EQ("maps came later than bounded", looking.ladder.why());
  looking.seen.latency = 100ms;
  int looks = 0;
  while (looking.next() == Fallback::wide_bound) {
    ++looks;
  }
  EXPECT_EQ(18, looks) << "until one of the two has left the window of twenty";
}

TEST(FallbackLadder, judges_a_map_by_the_bound_that_was_in_force_before_it) {
  Looking looking;
  static_cast<void>(looking.next());
  looking.seen.latency = 300ms;
  looking.seen.latency_bound = 330ms;  // It adapts at once.
  EXPECT_EQ(Fallback::none, looking.next());
  looking.seen.latency = 310ms;
  EXPECT_EQ(Fallback::none, looking.next()) << "within the bound since";
}

TEST(FallbackLadder, counts_a_map_once) {
  Looking looking;
  static_cast<void>(looking.next());
  looking.seen.latency = 300ms;
  static_cast<void>(looking.next());
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(Fallback::none, looking.ladder.look(looking.seen, looking.request));
  }
}

TEST(FallbackLadder, takes_the_table_while_the_input_cannot_be_believed) {
  for (const double x :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    Looking looking;
    looking.seen.speed_m_s = x;
    EXPECT_EQ(Fallback::table, looking.next()) << x;
    looking.seen.speed_m_s = 1.0;
    EXPECT_EQ(Fallback::none, looking.next());
  }
  Looking looking;
  looking.seen.latency = -1ms;
  EXPECT_EQ(Fallback::table, looking.next());
}

TEST(FallbackLadder, takes_the_table_when_the_platform_does_not_follow) {
  Looking looking;
  static_cast<void>(looking.next());
  looking.seen.frequency = Hertz{1e9};  // Throttled.
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(Fallback::none, looking.next()) << i << ": a switch takes its time";
  }
  EXPECT_EQ(Fallback::table, looking.next());
  looking.request.frequency_hz = 3e9;  // As the table does.
  EXPECT_EQ(Fallback::table, looking.next()) << "and not another second of the policy";
  looking.seen.frequency = Hertz{3e9};
  EXPECT_EQ(Fallback::none, looking.next());
}

/// Steps of the ladder in the next `looks`, after which the table's request is in force.
int tables_of(Looking& looking, int looks) {
  int tables = 0;
  for (int i = 0; i < looks; ++i) {
    tables += looking.next() == Fallback::table ? 1 : 0;
  }
  return tables;
}

TEST(FallbackLadder, goes_on_with_what_is_granted_when_the_table_got_no_more) {
  Looking looking;
  static_cast<void>(looking.next());
  looking.seen.frequency = Hertz{1e9};  // Throttled, for good.
  const int patience = 5;               // Looks: 1 s until the table, 2 s until it is given up.
  EXPECT_EQ(tables_of(looking, 40), 8);
  looking.request.frequency_hz = 8e8;
  looking.seen.frequency = Hertz{8e8};
  EXPECT_EQ(tables_of(looking, 20), 0) << "less than the cap is granted as ever";
  looking.request.frequency_hz = 2e9;
  looking.seen.frequency = Hertz{1e9};
  EXPECT_EQ(tables_of(looking, 20), 0) << "the cap is known";
  looking.seen.frequency = Hertz{5e8};  // Hotter still: news.
  EXPECT_EQ(tables_of(looking, patience), 1);
  EXPECT_GT(tables_of(looking, 40), 0);
  looking.seen.frequency = Hertz{2e9};  // Cool again.
  EXPECT_EQ(tables_of(looking, 20), 0);
  looking.seen.frequency = Hertz{1e9};
  EXPECT_EQ(tables_of(looking, 40), 8) << "the cap was forgotten when more was granted";
}

TEST(FallbackLadder, a_policy_that_changes_its_mind_is_no_mismatch) {
  Looking looking;
  for (int i = 0; i < 40; ++i) {
    looking.request.frequency_hz = 1e9 + i * 1e7;  // Granted is always the one before.
    EXPECT_EQ(Fallback::none, looking.next());
    looking.seen.frequency = Hertz{*looking.request.frequency_hz};
  }
}

TEST(FallbackLadder, a_policy_that_goes_to_and_fro_hides_no_mismatch) {
  Looking looking;
  looking.seen.frequency = Hertz{1e9};
  int looks = 0;
  do {
    looking.request.frequency_hz = looks / 3 % 2 == 0 ? 1.5e9 : 2e9;
    ++looks;
  } while (looking.next() == Fallback::none && looks < 100);
  EXPECT_EQ(5, looks) << "a second after the first look";
}

TEST(FallbackLadder, does_not_compare_what_nobody_tells) {
  Looking looking;
  looking.seen.frequency = Hertz{0.0};
  looking.request.cores.reset();
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(Fallback::none, looking.next());
  }
}

TEST(FallbackLadder, hovers_when_deadlines_are_missed_again_and_again) {
  Looking looking;
  looking.seen.deadline_misses = 2;
  int looks = 0;
  while (looking.next() != Fallback::hover && looks < 100) {
    ++looks;
  }
  EXPECT_EQ(3, looks) << "2, 3.4, 4.8 and then 6.1";
  looking.seen.deadline_misses = 0;
  looks = 0;
  while (looking.next() == Fallback::hover && looks < 100) {
    ++looks;
  }
  EXPECT_NEAR(looks, 9, 2) << "drained, and two seconds at least";
}

TEST(FallbackLadder, a_broken_counter_does_not_hold_it_for_hours) {
  Looking looking;
  looking.seen.deadline_misses = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(Fallback::hover, looking.next());
  looking.seen.deadline_misses = 0;
  int looks = 0;
  while (looking.next() == Fallback::hover) {
    ASSERT_LT(++looks, 40);
  }
}

TEST(FallbackLadder, can_be_switched_off) {
  FallbackSettings off;
  off.enabled = false;
  Looking looking{off};
  looking.seen.deadline_misses = 100;
  looking.seen.speed_m_s = -1.0;
  EXPECT_EQ(Fallback::none, looking.next());
}

TEST(FallbackLadder, takes_no_offence_at_a_clock_that_may_not_be_set_or_wavers) {
  Looking looking;
  looking.request.frequency_hz = 1.1e9;
  looking.seen.frequency = Hertz{2e9};  // More than was requested.
  EXPECT_EQ(tables_of(looking, 40), 0);
  looking.request.frequency_hz = 2.0352e9;
  for (int i = 0; i < 40; ++i) {  // The board has steps of 100 MHz, and its clock is measured.
    looking.seen.frequency = Hertz{2e9 + (i % 3 - 1) * 4e5};
    EXPECT_EQ(Fallback::none, looking.next());
  }
}

TEST(FallbackLadder, believes_in_a_cap_that_wavers) {
  Looking looking;
  static_cast<void>(looking.next());
  int tables = 0;
  for (int i = 0; i < 40; ++i) {
    looking.seen.frequency = Hertz{1e9 + (i % 3 - 1) * 2e5};
    tables += looking.next() == Fallback::table ? 1 : 0;
  }
  EXPECT_EQ(tables, 8) << "as for one that stands still";
}

}  // namespace
}  // namespace flyball
