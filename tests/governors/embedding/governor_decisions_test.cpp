// SPDX-License-Identifier: BSD-3-Clause
#include "governed_loop.h"
#include <algorithm>
#include <array>
#include <clocale>
#include <string>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

TEST(EmbeddedGovernor, turns_a_callers_knob_by_its_callback) {
  GovernedLoop loop;
  ASSERT_EQ(flyball_governor_ok, loop.open_density()) << loop.error();
  loop.observe("obstacle_density", 0.0);
  const FlyballGovernorDecision open = loop.decide(0.0);
  EXPECT_EQ(flyball_governor_ok, loop.code);
  EXPECT_EQ(1U, open.knob_count);
  EXPECT_EQ(0.80, open.decided[0]);
  EXPECT_EQ(0.80, open.in_force[0]);
  EXPECT_STREQ("density", open.reason);
  EXPECT_STREQ("none", open.fallback);
  EXPECT_STREQ("", open.why);
  loop.observe("obstacle_density", 0.2);
  EXPECT_EQ(0.15, loop.decide(10.0).in_force[0]);
  loop.decide(11.0);
  EXPECT_EQ((std::vector<double>{0.80, 0.15}), loop.applied) << "once for each change";
}

TEST(EmbeddedGovernor, moves_a_wish_to_the_nearest_legal_value) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorSettings settings = loop.settings("density");
  settings.parameters = "coarse_m = 0.5";
  ASSERT_EQ(flyball_governor_ok, loop.open(settings)) << loop.error();
  loop.observe("phase", flyball_governor_cruise);
  EXPECT_EQ(0.40, loop.decide(0.0).decided[0]);
}

TEST(EmbeddedGovernor, asks_for_start_values_until_somebody_says_what_the_vehicle_does) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  ASSERT_EQ(flyball_governor_ok, loop.open(loop.settings("density")));
  const FlyballGovernorDecision decision = loop.decide(0.0);
  EXPECT_EQ(flyball_governor_ok, loop.code);
  EXPECT_EQ(0.15, decision.decided[0]);
  EXPECT_STREQ("table", decision.fallback);
  EXPECT_STREQ("fallback", decision.reason);
  EXPECT_NE(std::string::npos, std::string{decision.why}.find("phase")) << decision.why;
}

TEST(EmbeddedGovernor, hovers_while_deadlines_are_missed_again_and_again) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(0U, loop.decide(0.0).must_hover);
  loop.observe("deadline_misses", 10.0);
  const FlyballGovernorDecision decision = loop.decide(0.1);
  EXPECT_EQ(1U, decision.must_hover);
  EXPECT_STREQ("hover", decision.fallback);
}

TEST(EmbeddedGovernor, takes_start_values_until_a_refused_signal_is_right_again) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(0.80, loop.decide(0.0).decided[0]);
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("obstacle_density", std::stod("nan")));
  const FlyballGovernorDecision refused = loop.decide(1.0);
  EXPECT_EQ(0.15, refused.decided[0]);
  EXPECT_STREQ("table", refused.fallback);
  EXPECT_EQ(flyball_governor_ok, loop.observe("obstacle_density", 0.0));
  EXPECT_EQ(0.80, loop.decide(2.0).decided[0]);
}

TEST(EmbeddedGovernor, records_a_line_for_each_decision) {
  GovernedLoop loop;
  loop.open_density();
  loop.observe("speed_m_s", 2.5);
  loop.decide(0.25);
  loop.granted = 0.4;
  loop.observe("obstacle_density", 0.5);
  loop.decide(10.0);
  ASSERT_EQ(2U, loop.lines.size());
  EXPECT_EQ(
      "t_s=0.25 mode=governing reason=density fallback=none map.resolution_m=0.80000000000000004 "
      "phase=1 speed_m_s=2.5 map_resolution_m=0.14999999999999999",
      loop.lines[0]);
  EXPECT_NE(std::string::npos, loop.lines[1].find("map.resolution_m=0.14999999999999999 "
                                                  "map.resolution_m.in_force=0.40000000000000002"))
      << loop.lines[1];
}

TEST(EmbeddedGovernor, records_numbers_with_a_point_whatever_the_locale_of_the_host) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  const std::array<const char*, 5> with_comma{"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE",
                                              "nl_NL.UTF-8"};
  if (std::none_of(with_comma.begin(), with_comma.end(),
                   [](const char* name) { return std::setlocale(LC_NUMERIC, name) != nullptr; })) {
    GTEST_SKIP() << "no locale with a decimal comma is installed";
  }
  GovernedLoop loop;
  loop.open_density();
  loop.observe("speed_m_s", 2.5);
  loop.decide(0.25);
  std::setlocale(LC_NUMERIC, before.c_str());
  EXPECT_EQ(
      "t_s=0.25 mode=governing reason=density fallback=none map.resolution_m=0.80000000000000004 "
      "phase=1 speed_m_s=2.5 map_resolution_m=0.14999999999999999",
      loop.lines.at(0));
}

TEST(EmbeddedGovernor, quotes_the_reason_of_a_fallback_in_the_record) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  loop.open(loop.settings("density"));
  loop.decide(0.0);
  EXPECT_NE(std::string::npos, loop.lines.at(0).find(" why=\"the observation's phase"))
      << loop.lines.at(0);
}

TEST(EmbeddedGovernor, lists_every_knob_and_measure_beside_the_signals) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  FlyballGovernorKnob range = loop.cell_knob();
  range.name = "map.range_m";
  range.description = "How far the map reaches";
  range.legal_count = 0;
  range.min = 5.0;
  range.max = 25.0;
  range.start = 7.0;
  ASSERT_EQ(flyball_governor_ok, loop.add(range)) << loop.error();
  FlyballGovernorStage mapping = GovernedLoop::stage("mapping");
  const char* const work[] = {"cells", "rays"};
  mapping.work = work;
  mapping.work_count = 2;
  ASSERT_EQ(flyball_governor_ok, loop.add(mapping)) << loop.error();
  const auto all = loop.list();
  for (const auto& [name, entry] : all) {
    EXPECT_STRNE("", entry.unit) << name;
    EXPECT_STRNE("", entry.description) << name;
  }
  const FlyballGovernorEntry& cells = all.at("map.resolution_m");
  EXPECT_EQ(std::uint32_t{flyball_governor_knob}, cells.kind);
  ASSERT_EQ(3U, cells.legal_count);
  EXPECT_EQ(0.40, cells.legal[1]);
  EXPECT_EQ(0.15, cells.value);
  EXPECT_EQ(0.15, cells.min);
  EXPECT_EQ(0.80, cells.max);
  EXPECT_EQ(nullptr, all.at("map.range_m").legal);
  EXPECT_EQ(25.0, all.at("map.range_m").max);
  EXPECT_EQ(std::uint32_t{flyball_governor_duration}, all.at("mapping.duration_s").kind);
  EXPECT_EQ(std::uint32_t{flyball_governor_work}, all.at("mapping.rays").kind);
  EXPECT_EQ(0U, all.at("mapping.rays").is_known);
}

TEST(EmbeddedGovernor, governs_two_loops_side_by_side) {
  GovernedLoop one;
  GovernedLoop other;
  one.open_density();
  other.open_density();
  other.observe("obstacle_density", 0.5);
  EXPECT_EQ(0.80, one.decide(0.0).decided[0]);
  EXPECT_EQ(0.15, other.decide(0.0).decided[0]);
}

}  // namespace
}  // namespace flyball::kit
