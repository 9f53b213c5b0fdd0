// SPDX-License-Identifier: BSD-3-Clause
#include "governed_loop.h"
#include <stdexcept>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

/// Coarse at 0 s, fine from 10 s on.
void decide_twice(GovernedLoop& loop) {
  loop.observe("obstacle_density", 0.0);
  loop.decide(0.0);
  loop.observe("obstacle_density", 0.5);
  loop.decide(10.0);
}

TEST(CallersKnobs, say_what_was_granted_from_their_callback_or_later) {
  GovernedLoop loop;
  loop.open_density();
  loop.granted = 0.7;
  FlyballGovernorDecision decision = loop.decide(0.0);
  EXPECT_EQ(0.80, decision.decided[0]);
  EXPECT_EQ(0.7, decision.in_force[0]);
  EXPECT_EQ(flyball_governor_ok, flyball_governor_granted(loop.governor, "map.resolution_m", 0.6));
  decision = loop.decide(1.0);
  EXPECT_EQ(0.6, decision.in_force[0]);
  EXPECT_EQ(0.6, loop.signal("map_resolution_m"));
  EXPECT_EQ(1U, loop.applied.size()) << "what was granted once is not asked for again";
}

TEST(CallersKnobs, that_could_not_be_applied_are_asked_again) {
  GovernedLoop loop;
  loop.open_density();
  loop.refusal = 5;
  const FlyballGovernorDecision decision = loop.decide(0.0);
  EXPECT_EQ(flyball_governor_failed, loop.code);
  EXPECT_EQ(
      "knob \"map.resolution_m\" could not be set to 0.8 m; it is asked again at the next decision",
      loop.error());
  EXPECT_EQ(0.80, decision.decided[0]) << "the decision is there all the same";
  EXPECT_EQ(0.15, decision.in_force[0]);
  loop.refusal = 0;
  EXPECT_EQ(0.80, loop.decide(1.0).in_force[0]);
  EXPECT_EQ(flyball_governor_ok, loop.code);
  EXPECT_EQ((std::vector<double>{0.80, 0.80}), loop.applied);
}

TEST(CallersKnobs, without_a_callback_are_in_force_as_decided) {
  GovernedLoop loop;
  FlyballGovernorKnob knob = loop.cell_knob();
  knob.apply = nullptr;
  loop.add(knob);
  loop.open(loop.settings("density"));
  loop.observe("phase", flyball_governor_cruise);
  EXPECT_EQ(0.80, loop.decide(0.0).in_force[0]);
}

TEST(CallersKnobs, keep_a_value_as_long_as_they_ask_for) {
  GovernedLoop loop;
  FlyballGovernorKnob knob = loop.cell_knob();
  knob.min_dwell_s = 30.0;
  loop.add(knob);
  loop.open(loop.settings("density"));
  loop.observe("phase", flyball_governor_cruise);
  decide_twice(loop);
  EXPECT_EQ((std::vector<double>{0.80}), loop.applied);
  loop.decide(31.0);
  EXPECT_EQ((std::vector<double>{0.80, 0.15}), loop.applied);
}

TEST(CallersKnobs, wait_together_with_the_one_that_they_follow) {
  GovernedLoop loop;
  FlyballGovernorKnob cells = loop.cell_knob();
  cells.min_dwell_s = 30.0;
  loop.add(cells);
  FlyballGovernorKnob range = cells;
  range.name = "map.range_m";
  range.legal_count = 0;
  range.min = 2.0;
  range.max = 25.0;
  range.start = 7.0;
  range.min_dwell_s = 0.1;
  range.apply = nullptr;
  range.follows = "map.resolution_m";
  loop.add(range);
  FlyballGovernorSettings settings = loop.settings("density");
  settings.parameters = "coarse_range_m = 20";
  loop.open(settings);
  loop.observe("phase", flyball_governor_cruise);
  decide_twice(loop);
  EXPECT_EQ(20.0, loop.decide(29.0).in_force[1]) << "with the cells";
  const FlyballGovernorDecision fine = loop.decide(31.0);
  EXPECT_EQ(0.15, fine.in_force[0]);
  EXPECT_EQ(7.0, fine.in_force[1]);
}

TEST(CallersKnobs, survive_a_callback_that_throws) {
  GovernedLoop loop;
  FlyballGovernorKnob knob = loop.cell_knob();
  knob.apply = [](void*, double) -> std::int32_t { throw std::runtime_error{"no"}; };
  loop.add(knob);
  loop.open(loop.settings("density"));
  loop.observe("phase", flyball_governor_cruise);
  EXPECT_EQ(0.15, loop.decide(0.0).in_force[0]);
  EXPECT_EQ(flyball_governor_failed, loop.code);
}

TEST(CallersKnobs, refuse_a_callback_that_calls_more_than_it_may) {
  GovernedLoop loop;
  FlyballGovernorKnob knob = loop.cell_knob();
  static constexpr auto misbehave = [](void* self, double) -> std::int32_t {
    auto& mine = *static_cast<GovernedLoop*>(self);
    flyball_governor_close(mine.governor);
    return flyball_governor_decide(mine.governor, 1.0, nullptr);
  };
  knob.apply = misbehave;
  loop.add(knob);
  loop.open(loop.settings("density"));
  loop.observe("phase", flyball_governor_cruise);
  loop.decide(0.0);
  EXPECT_EQ(flyball_governor_failed, loop.code);
  EXPECT_EQ(1U, loop.lines.size()) << "one decision, and the governor is still there";
}

TEST(CallersKnobs, fall_back_when_another_clock_is_granted_for_a_second) {
  GovernedLoop loop;
  loop.add(loop.clock_knob());
  loop.add(loop.cell_knob());
  loop.open(loop.settings("performance"));
  loop.observe("phase", flyball_governor_cruise);
  EXPECT_EQ(2.0e9, loop.decide(0.0).in_force[0]);
  flyball_governor_granted(loop.governor, "cpu.frequency_hz", 0.5e9);
  EXPECT_STREQ("none", loop.decide(0.1).fallback);
  EXPECT_STREQ("table", loop.decide(1.2).fallback);
}

TEST(DryRun, calls_nothing_back_and_leaves_start_values_in_force) {
  const Environment dry{"FLYBALL_DRY_RUN", "1"};
  GovernedLoop loop;
  loop.open_density();
  const FlyballGovernorDecision decision = loop.decide(0.0);
  EXPECT_EQ(std::uint32_t{flyball_governor_dry_run}, decision.mode);
  EXPECT_EQ(0.80, decision.decided[0]);
  EXPECT_EQ(0.15, decision.in_force[0]);
  EXPECT_EQ(flyball_governor_ok, flyball_governor_granted(loop.governor, "map.resolution_m", 0.4));
  EXPECT_EQ(0.15, loop.decide(1.0).in_force[0]) << "it does not listen";
  EXPECT_TRUE(loop.applied.empty());
  ASSERT_EQ(2U, loop.lines.size());
  EXPECT_NE(std::string::npos, loop.lines[0].find("mode=dry_run")) << loop.lines[0];
}

TEST(Shadow, decides_for_what_the_caller_has_in_force_and_touches_nothing) {
  const Environment shadow{"FLYBALL_SHADOW", "yes"};
  const Environment dry{"FLYBALL_DRY_RUN", "1"};  // Shadow counts.
  GovernedLoop loop;
  loop.open_density();
  FlyballGovernorDecision decision = loop.decide(0.0);
  EXPECT_EQ(std::uint32_t{flyball_governor_shadow}, decision.mode);
  EXPECT_EQ(0.80, decision.decided[0]);
  EXPECT_EQ(0.15, decision.in_force[0]);
  flyball_governor_granted(loop.governor, "map.resolution_m", 0.4);
  decision = loop.decide(1.0);
  EXPECT_EQ(0.80, decision.decided[0]);
  EXPECT_EQ(0.4, decision.in_force[0]);
  EXPECT_EQ(0.4, loop.signal("map_resolution_m"));
  EXPECT_TRUE(loop.applied.empty());
  EXPECT_EQ(2U, loop.lines.size());
}

TEST(Shadow, takes_another_clock_than_it_decided_for_no_fault) {
  const Environment shadow{"FLYBALL_SHADOW", "1"};
  GovernedLoop loop;
  loop.add(loop.clock_knob());
  loop.open(loop.settings("performance"));
  loop.observe("phase", flyball_governor_cruise);
  for (int i = 0; i < 100; ++i) {
    ASSERT_STREQ("none", loop.decide(0.1 * i).fallback);
  }
}

TEST(Shadow, is_off_where_the_variable_is_zero_or_empty) {
  const Environment shadow{"FLYBALL_SHADOW", "0"};
  const Environment dry{"FLYBALL_DRY_RUN", ""};
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(std::uint32_t{flyball_governor_governing}, loop.decide(0.0).mode);
}

TEST(Shadow, makes_the_same_decisions_as_a_governor_that_acts) {
  const auto decided = [](GovernedLoop& loop) {
    loop.open_density();
    std::vector<double> all;
    for (int i = 0; i < 200; ++i) {
      loop.observe("obstacle_density", i / 20 % 2 == 0 ? 0.0 : 0.5);
      all.push_back(loop.decide(0.25 * i).decided[0]);
    }
    return all;
  };
  GovernedLoop governing;
  const auto expected = decided(governing);
  EXPECT_LT(3U, governing.applied.size());
  const Environment shadow{"FLYBALL_SHADOW", "1"};
  GovernedLoop watching;
  EXPECT_EQ(expected, decided(watching));
  EXPECT_TRUE(watching.applied.empty());
}

}  // namespace
}  // namespace flyball::kit
