// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mission_setup.h"

#include "flyball/scenario/files.h"

#include "cruising.h"
#include "scratch_folder.h"
#include "short_delivery.h"
#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string refusal(const Scenario& scenario) {
  const auto setup = set_up(scenario);
  return setup ? "" : setup.error().message;
}

TEST(MissionSetup, makes_everything_that_the_default_scenario_names) {
  const auto setup = set_up(Scenario{});
  ASSERT_TRUE(setup.ok()) << setup.error().message;
  EXPECT_EQ(setup->platform->name(), "jetson_tx2");
  EXPECT_NE(setup->equipment.kernels.mapper, nullptr);
  EXPECT_NE(setup->governor, nullptr);
}

/// The TX2's file with these words in place of others.
std::string shipped_platform_with(const std::map<std::string, std::string>& others) {
  std::ifstream in{find_shipped("platforms", "jetson_tx2").value()};
  std::string text{std::istreambuf_iterator<char>{in}, {}};
  for (const auto& [before, after] : others) {
    text.replace(text.find(before), before.size(), after);
  }
  return text;
}

/// The watts at the lowest clock with a core busy that the policy of such a mission is told.
double told_w(const ScratchFolder& folder, Scenario scenario) {
  scenario.governor.policy = folder.file("asks.lua",
                                         "function start(given, knobs, board)\n"
                                         "  local low = board.clocks[1]\n"
                                         "  watts = low.idle_w + low.busy_core_w\n"
                                         "end\n"
                                         "function decide() return {['map.range_m'] = watts} end");
  const auto setup = set_up(scenario);
  EXPECT_TRUE(setup.ok()) << setup.error().message;
  Observation seen;
  seen.phase = MissionPhase::cruise;
  static_cast<void>(setup->governor->decide(seen));
  return setup->governor->wished().begin()->value;
}

TEST(MissionSetup, tells_the_policy_what_its_platform_draws) {
  const ScratchFolder folder;
  Scenario scenario;
  const auto setup = set_up(scenario);
  ASSERT_TRUE(setup.ok()) << setup.error().message;
  const Hertz lowest = setup->platform->frequencies().front();
  const double usual_w = told_w(folder, scenario);
  EXPECT_NEAR(usual_w, setup->platform->power({4, lowest}, 1.0).value(), 1e-9);
  scenario.platform.name =
      folder.file("hungry.toml", shipped_platform_with({{"board_w = 0.6 ", "board_w = 40.0 "}}));
  EXPECT_NEAR(told_w(folder, scenario) - usual_w, 40.0 - 0.6, 1e-9);
}

TEST(MissionSetup, names_what_it_does_not_know_and_where_the_names_are_listed) {
  Scenario scenario;
  scenario.kernels.planner = "teleport";
  scenario.kernels.mapper = "crayon";
  const std::string why = refusal(scenario);
  EXPECT_NE(why.find("\"teleport\""), std::string::npos) << why;
  EXPECT_NE(why.find("\"crayon\""), std::string::npos) << why;
  EXPECT_NE(why.find("flyball list kernels"), std::string::npos) << why;
  scenario = Scenario{};
  scenario.world.generator = "moon";
  EXPECT_NE(refusal(scenario).find("flyball list worlds"), std::string::npos);
  scenario = Scenario{};
  scenario.governor.policy = "just_in_tme";
  EXPECT_NE(refusal(scenario).find("flyball list policies"), std::string::npos);
}

TEST(MissionSetup, may_fly_an_applications_policy_with_a_clock_rule_beside_it) {
  const ScratchFolder folder;
  Scenario scenario;
  scenario.governor.policy =
      folder.file("both.toml", "application = 'fixed_coarse'\nclock = 'powersave'\n");
  const auto setup = set_up(scenario);
  ASSERT_TRUE(setup.ok()) << setup.error().message;
  std::map<std::string, double> wished;
  Observation seen;
  seen.phase = MissionPhase::cruise;
  for (const auto& [knob, value] : setup->governor->decide(seen)) {
    wished[std::string{knob}] = value;
  }
  EXPECT_EQ(wished["map.resolution_m"], 0.80);
  EXPECT_EQ(wished["cpu.frequency_hz"], setup->platform->frequencies().front().value());
  scenario.governor.policy = folder.file(
      "twice.toml", "application = '" + scenario.governor.policy + "'\nclock = 'powersave'\n");
  EXPECT_NE(refusal(scenario).find("combination itself"), std::string::npos);
}

/// The shipped platform without a price for the brick map.
std::string older_platform() {
  return shipped_platform_with(
      {{"[kernels.flyball]", "[kernels.another]"},
       {"[kernels.flyball.seconds_per]", "[kernels.another.seconds_per]"}});
}

/// The longest response among the settings that `mission_energy` compares.
double longest_response_s(double brake_lag_s) {
  Scenario scenario;
  scenario.governor.policy = "mission_energy";
  scenario.vehicle.brake_lag_s = brake_lag_s;
  const auto setup = set_up(scenario);
  EXPECT_TRUE(setup.ok()) << setup.error().message;
  static_cast<void>(setup->governor->decide(kit::cruising()));
  double longest_s = 0.0;
  for (const PolicyOption& option : setup->governor->options()) {
    longest_s = std::max(longest_s, option.response_s);
  }
  return longest_s;
}

TEST(MissionSetup, tells_the_policy_how_late_the_vehicle_brakes) {
  EXPECT_NEAR(longest_response_s(0.7), longest_response_s(0.1) + 0.6, 1e-9);
}

TEST(MissionSetup, refuses_a_mapper_whose_time_the_platform_cannot_tell) {
  const ScratchFolder folder;
  Scenario scenario;
  scenario.platform.name = folder.file("older.toml", older_platform());
  scenario.kernels.mapper = "flyball";
  const auto unpriced = set_up(scenario);
  ASSERT_FALSE(unpriced.ok());
  EXPECT_NE(unpriced.error().message.find("no price for mapper \"flyball\""), std::string::npos)
      << unpriced.error().message;
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  EXPECT_TRUE(set_up(scenario).ok());
}

TEST(MissionSetup, refuses_a_place_that_is_larger_than_the_map_can_be) {
  Scenario scenario;
  scenario.world.generator = "empty";
  scenario.world.parameters["goal_distance_m"] = 1000.0;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  scenario.kernels.mapper_parameters["finest_m"] = 0.03;
  scenario.map.resolution_m = 0.24;
  const auto setup = set_up(scenario);
  ASSERT_FALSE(setup);
  EXPECT_EQ(setup.error().message.rfind("world \"empty\" reaches to (1020, 40) m, and", 0), 0U)
      << setup.error().message;
  EXPECT_NE(setup.error().message.find("larger cells"), std::string::npos);
  scenario.world.parameters["goal_distance_m"] = 900.0;
  EXPECT_TRUE(set_up(scenario));
}

TEST(MissionSetup, is_not_flown_with_a_planner_that_the_platform_has_no_price_for) {
  const ScratchFolder folder;
  Scenario scenario = kit::short_delivery();
  const std::string table = "[kernels." + scenario.kernels.planner;
  scenario.platform.name = folder.file(
      "older.toml",
      shipped_platform_with({{table + "]", "[kernels.another]"},
                             {table + ".seconds_per]", "[kernels.another.seconds_per]"}}));
  const auto refused = fly(scenario, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("of node \"plan\", so its jobs would cost no time"),
            std::string::npos)
      << refused.error().message;
  scenario.edge.platform = scenario.platform.name;
  scenario.platform.name = Scenario{}.platform.name;
  const auto refused_afar = fly(scenario, {});
  ASSERT_FALSE(refused_afar.ok());
  EXPECT_EQ(refused_afar.error().message.rfind("edge platform \"" + scenario.edge.platform, 0), 0U)
      << refused_afar.error().message;
}

TEST(MissionSetup, gives_the_governor_a_watchdog_where_it_is_given_a_clock) {
  int asked = 0;
  const auto slow = [&asked] { return HostTime{std::chrono::seconds{++asked}}; };
  Observation seen;
  seen.phase = MissionPhase::cruise;
  const auto watched = set_up(Scenario{}, slow);
  ASSERT_TRUE(watched.ok()) << watched.error().message;
  (void)watched->governor->decide(seen);
  EXPECT_EQ(watched->governor->last_fault(), PolicyFault::overtime);
  const auto unwatched = set_up(Scenario{});
  ASSERT_TRUE(unwatched.ok()) << unwatched.error().message;
  (void)unwatched->governor->decide(seen);
  EXPECT_EQ(unwatched->governor->last_fault(), PolicyFault::none);
}

TEST(MissionSetup, refuses_a_power_model_that_the_airframe_has_no_numbers_for) {
  Scenario scenario;
  scenario.vehicle.airframe = "f450";
  scenario.vehicle.payload_kg = 0.0;
  EXPECT_NE(refusal(scenario).find("thrust"), std::string::npos);
  scenario.vehicle.rotor_power = "thrust";
  EXPECT_EQ(refusal(scenario), "");
}

// By hand: .3 kg at a thrust to weight of 2.194 lift .548 kg at 1.2.
TEST(MissionSetup, refuses_a_payload_that_the_vehicle_cannot_lift) {
  Scenario scenario;
  scenario.vehicle.airframe = "spark";
  scenario.vehicle.payload_kg = 0.24;
  EXPECT_EQ(refusal(scenario), "");
  scenario.vehicle.payload_kg = 0.5;
  EXPECT_EQ(
      refusal(scenario),
      "vehicle.payload_kg = 0.5 is too heavy for airframe \"spark\", which lifts 0.248 with a "
      "fifth of its thrust to spare; carry less");
}

// By hand: the spark's .248 kg, less the gimbal's .15 kg; the tello lifts 43 g.
TEST(MissionSetup, counts_the_gimbal_of_who_looks_for_people_as_payload) {
  Scenario scenario;
  scenario.mission.workload = "aerial_photography";
  scenario.vehicle.airframe = "spark";
  scenario.vehicle.payload_kg = 0.09;
  EXPECT_EQ(refusal(scenario).find("too heavy"), std::string::npos) << refusal(scenario);
  scenario.vehicle.payload_kg = 0.11;
  EXPECT_EQ(refusal(scenario),
            "vehicle.payload_kg = 0.11 with the gimbal of 0.15 kg that workload "
            "\"aerial_photography\" needs is too heavy for airframe \"spark\", which lifts 0.248 "
            "with a fifth of its thrust to spare; carry less");
  scenario.vehicle.airframe = "tello";
  scenario.vehicle.payload_kg = 0.0;
  const std::string why = refusal(scenario);
  EXPECT_NE(why.find("lifts 0.043 with"), std::string::npos) << why;
  EXPECT_NE(why.find("choose a larger vehicle.airframe"), std::string::npos) << why;
}

}  // namespace
}  // namespace flyball
