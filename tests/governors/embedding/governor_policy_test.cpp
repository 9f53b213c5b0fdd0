// SPDX-License-Identifier: BSD-3-Clause
#include "governed_loop.h"
#include "scratch_folder.h"
#include <string>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

std::string refusal(const char* policy, const char* parameters = nullptr) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorSettings settings = loop.settings(policy);
  settings.parameters = parameters;
  EXPECT_NE(flyball_governor_ok, loop.open(settings)) << policy;
  EXPECT_EQ(std::string::npos, loop.error().find('\n')) << loop.error();
  return loop.error();
}

TEST(EmbeddedPolicy, is_refused_with_the_names_that_there_are) {
  const std::string names =
      "conservative, cycle, density, energy_clock, fixed, gap_switch, interactive, mission_energy, "
      "ondemand, performance, powersave, schedutil";
  EXPECT_EQ("this library has no policy \"dense\"; it has " + names, refusal("dense"));
  EXPECT_EQ("settings need a policy: a file, or one of " + names, refusal(nullptr));
  EXPECT_EQ("settings need a policy: a file, or one of " + names, refusal(""));
}

TEST(EmbeddedPolicy, needs_the_knobs_that_it_turns) {
  EXPECT_EQ("policy \"performance\": there is no knob cpu.frequency_hz with a list of clocks",
            refusal("performance"));
}

TEST(EmbeddedPolicy, takes_parameters_as_text) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorSettings settings = loop.settings("density");
  settings.parameters = "coarse_m = 0.4\nenter_density = 0.5 # far more than usual\n";
  ASSERT_EQ(flyball_governor_ok, loop.open(settings)) << loop.error();
  loop.observe("phase", flyball_governor_cruise);
  loop.observe("obstacle_density", 0.4);
  EXPECT_EQ(0.4, loop.decide(0.0).decided[0]);
}

TEST(EmbeddedPolicy, says_what_is_wrong_with_its_parameters) {
  EXPECT_NE(std::string::npos, refusal("density", "coarse = 0.4").find("\"coarse\""));
  EXPECT_NE(std::string::npos, refusal("density", "coarse_m = 99").find("99"));
  EXPECT_NE(std::string::npos, refusal("density", "coarse_m 0.4").find("parameters:1"));
  EXPECT_NE(std::string::npos, refusal("density", "\ncoarse_m = [1]").find("parameters:2"));
  EXPECT_NE(std::string::npos, refusal("density", "[parameters]\ncoarse_m = 1").find("parameters"));
  EXPECT_NE(std::string::npos, refusal("density", "fine_m = 0.9").find("must be below"));
}

TEST(EmbeddedPolicy, comes_from_a_preset_whose_parameters_the_caller_may_change) {
  const std::string file = std::string{FLYBALL_EXAMPLE_POLICIES} + "/density_switch.toml";
  for (const bool changes : {false, true}) {
    GovernedLoop loop;
    loop.add(loop.cell_knob());
    FlyballGovernorSettings settings = loop.settings(file.c_str());
    settings.parameters = changes ? "coarse_m = 0.7" : nullptr;
    ASSERT_EQ(flyball_governor_ok, loop.open(settings)) << loop.error();
    loop.observe("phase", flyball_governor_cruise);
    EXPECT_EQ(changes ? 0.8 : 0.4, loop.decide(0.0).decided[0]) << "of .6 as it stands there";
  }
}

TEST(EmbeddedPolicy, comes_from_a_library_in_a_process_of_its_own) {
  const std::string file = std::string{FLYBALL_TEST_PLUGINS} + "/culprit.so";
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorKnob range = loop.cell_knob();
  range.name = "map.range_m";
  loop.add(range);
  ASSERT_EQ(flyball_governor_ok, loop.open(loop.settings(file.c_str()))) << loop.error();
  loop.observe("phase", flyball_governor_cruise);
  const FlyballGovernorDecision decision = loop.decide(0.0);
  EXPECT_STREQ("none", decision.fallback) << decision.why;
  EXPECT_STREQ("load", decision.reason);
}

TEST(EmbeddedPolicy, that_dies_in_its_process_leaves_the_caller_with_start_values) {
  const std::string file = std::string{FLYBALL_TEST_PLUGINS} + "/culprit.so";
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorSettings settings = loop.settings(file.c_str());
  settings.parameters = "crime = 3";  // It crashes.
  ASSERT_EQ(flyball_governor_ok, loop.open(settings)) << loop.error();
  loop.observe("phase", flyball_governor_cruise);
  for (int i = 0; i < 10; ++i) {  // No signal of the dead process reaches the caller.
    const FlyballGovernorDecision decision = loop.decide(i);
    ASSERT_STREQ("safe_static", decision.fallback);
    EXPECT_STRNE("", decision.why);
    EXPECT_EQ(0.15, decision.in_force[0]);
  }
}

TEST(EmbeddedPolicy, cannot_be_a_script) {
  const std::string file = std::string{FLYBALL_EXAMPLE_POLICIES} + "/density_switch.lua";
  EXPECT_NE(std::string::npos, refusal(file.c_str()).find("the C library never has"));
}

TEST(EmbeddedPolicy, that_is_no_file_is_named) {
  EXPECT_NE(std::string::npos, refusal("/nowhere/mine.toml").find("/nowhere/mine.toml"));
  EXPECT_NE(std::string::npos, refusal("/nowhere/libmine.so").find("/nowhere/libmine.so"));
}

/// With knobs that mission_energy has, and some power for it to reckon with.
struct EnergyLoop : GovernedLoop {
  EnergyLoop() {
    add(cell_knob());
    FlyballGovernorKnob range = cell_knob();
    range.name = "map.range_m";
    range.legal_count = 0;
    range.min = 5.0;
    range.max = 25.0;
    range.start = 12.0;
    add(range);
    FlyballGovernorKnob budget = range;
    budget.name = "planner.budget";
    budget.unit = "1";
    budget.max = 5000.0;
    budget.start = 1000.0;
    add(budget);
    add(clock_knob());
    board.struct_size = sizeof board;
    board.max_cores = 4;
    board.clocks_hz = clocks_hz;
    board.clock_count = 3;
    board.converter = 1.1;
    board.soc_w = 1.0;
    board.core_cubic_w = 0.3;
  }
  /// Opened, in flight.
  void fly(const char* policy, double speed_m_s, double reaction_s) {
    FlyballGovernorSettings given = settings(policy);
    given.board = &board;
    given.reaction_s = reaction_s;
    ASSERT_EQ(flyball_governor_ok, open(given)) << error();
    observe("phase", flyball_governor_cruise);
    observe("speed_m_s", speed_m_s);
    observe("known_free_m", 10.0);
    observe("max_deceleration_m_s2", 5.0);
  }
  FlyballGovernorBoard board{};
};

TEST(EmbeddedPolicy, can_reckon_with_the_power_of_the_board) {
  EnergyLoop loop;
  ASSERT_EQ(flyball_governor_invalid_input, loop.open(loop.settings("mission_energy")));
  EXPECT_NE(std::string::npos, loop.error().find("power")) << loop.error();
  loop.fly("mission_energy", 3.0, 0.0);
  loop.observe("speed_limit_m_s", 8.0);
  for (int i = 0; i < 100; ++i) {
    loop.observe("latency_s", 0.1);
    const FlyballGovernorDecision decision = loop.decide(0.25 * i);
    ASSERT_STREQ("none", decision.fallback) << decision.why;
    EXPECT_STREQ("energy", decision.reason);
  }
}

/// At the mission's own limit of speed, after a frame.
double clock_hz_of_one_that_brakes_after(double reaction_s) {
  constexpr double limit_m_s = 1.0;
  constexpr int clock = 3;  // The last knob.
  EnergyLoop loop;
  loop.fly("energy_clock", limit_m_s, reaction_s);
  loop.observe("speed_limit_m_s", limit_m_s);
  loop.observe("latency_s", 1.0);
  return loop.decide(1.0).decided[clock];
}

TEST(EmbeddedPolicy, can_reckon_with_the_callers_own_reaction_time) {
  EXPECT_LT(clock_hz_of_one_that_brakes_after(0.0), 2.0e9);
  EXPECT_EQ(clock_hz_of_one_that_brakes_after(9.0), 2.0e9) << "latency limits it below 1 m/s";
}

TEST(EmbeddedPolicy, refuses_a_board_that_cannot_be) {
  const double descending[] = {2.0e9, 1.0e9};
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorBoard board{};
  FlyballGovernorSettings settings = loop.settings("density");
  settings.board = &board;
  EXPECT_NE(flyball_governor_ok, loop.open(settings));
  EXPECT_EQ("the board's struct_size is 0; set it to sizeof(FlyballGovernorBoard)", loop.error());
  board.struct_size = sizeof board;
  board.clock_count = 2;
  EXPECT_NE(flyball_governor_ok, loop.open(settings));
  EXPECT_EQ("the board has 2 clocks, but clocks_hz is NULL", loop.error());
  board.clocks_hz = descending;
  EXPECT_NE(flyball_governor_ok, loop.open(settings));
  EXPECT_EQ("the board's clocks_hz must be positive and ascending; number 1 is not", loop.error());
  board.clock_count = 1;
  board.max_cores = 1U << 31U;
  EXPECT_NE(flyball_governor_ok, loop.open(settings));
  board.max_cores = 0;
  EXPECT_EQ(flyball_governor_ok, loop.open(settings)) << loop.error();
}

}  // namespace
}  // namespace flyball::kit
