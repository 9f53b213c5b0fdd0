// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/simulation/mission.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// In a forest, for 12 s.
Scenario watching(double height_m, const std::string& policy) {
  Scenario scenario;
  scenario.name = "short_watch";
  scenario.mission.workload = "watch";
  scenario.watch.time_s = 12.0;
  scenario.watch.height_m = height_m;
  scenario.world.generator = "forest";
  scenario.world.parameters = {{"goal_distance_m", 30.0}, {"width_m", 20.0}};
  scenario.vehicle.payload_kg = 0.0;
  scenario.vehicle.airframe = "tello";
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  scenario.kernels.slam_load = false;
  scenario.governor.policy = policy;
  return scenario;
}

Summary flown(const Scenario& scenario) {
  const auto record = fly(scenario, {});
  EXPECT_TRUE(record.ok()) << record.error().message;
  return record.ok() ? record->summary : Summary{};
}

TEST(Watch, perched_takes_no_energy_but_the_computers) {
  const Summary summary = flown(watching(0.0, "fixed_fine"));
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_EQ(summary.energy_rotor_j, 0.0);
  EXPECT_GT(summary.energy_computer_j, 12.0 * 1.9);  // An idle TX2 takes that.
  EXPECT_NEAR(summary.mission_time_s, 12.0, 1.0);
  EXPECT_GT(summary.quality.at("maps_watched"), 5.0);
}

TEST(Watch, hovers_where_it_is_told_and_lands) {
  const Summary summary = flown(watching(2.0, "fixed_fine"));
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_GT(summary.hover_time_s, 11.0);
  // Up and down 2 m, and little else.
  EXPECT_NEAR(summary.distance_m, 4.0, 1.0);
  EXPECT_GT(summary.energy_rotor_j, 12.0 * 20.0);  // The Tello's hover.
}

TEST(Watch, a_lower_clock_saves_a_quarter_of_the_computers_energy_while_nothing_flies) {
  const double usual_j = flown(watching(0.0, "fixed_fine")).energy_computer_j;
  for (const char* policy : {"fixed_fine_energy_clock", "mission_energy"}) {
    const Summary saving = flown(watching(0.0, policy));
    EXPECT_EQ(saving.status, MissionStatus::succeeded) << policy;
    EXPECT_LE(saving.quality.at("longest_without_map_s"), 2.0) << policy;
    EXPECT_LT(saving.energy_computer_j, 0.75 * usual_j) << policy;
  }
}

TEST(Watch, a_mission_that_needs_maps_less_often_takes_less) {
  for (const char* policy : {"fixed_fine_energy_clock", "mission_energy"}) {
    Scenario scenario = watching(0.0, policy);
    scenario.watch.longest_s = 1.3;
    const double often_j = flown(scenario).energy_computer_j;
    scenario.watch.longest_s = 4.0;
    const Summary seldom = flown(scenario);
    EXPECT_EQ(seldom.status, MissionStatus::succeeded) << policy;
    EXPECT_LT(seldom.energy_computer_j, 0.95 * often_j) << policy;
  }
}

TEST(Watch, fails_when_the_news_is_too_old) {
  Scenario scenario = watching(0.0, "fixed_fine");
  scenario.platform.frequency_hz = 345.6e6;  // Two seconds and more for a map.
  const Summary summary = flown(scenario);
  EXPECT_EQ(summary.failure, MissionFailure::incomplete);
  EXPECT_GT(summary.quality.at("longest_without_map_s"), 2.0);
}

TEST(Watch, at_the_goal_flies_there_stands_and_comes_home) {
  Scenario scenario = watching(0.0, "fixed_fine");
  scenario.watch.at_goal = true;
  const auto record = fly(scenario, {});
  ASSERT_TRUE(record.ok()) << record.error().message;
  const Summary& summary = record->summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_TRUE(record->has_goal);
  EXPECT_GT(summary.distance_m, 60.0);  // Twice the 30 m to the goal.
  EXPECT_GT(summary.quality.at("maps_watched"), 5.0);
  Scenario shorter = scenario;
  shorter.watch.time_s = 4.0;
  const Summary less = flown(shorter);
  // Standing at the goal takes time, and not the rotors' energy.
  EXPECT_NEAR(summary.mission_time_s - less.mission_time_s, 8.0, 1.0);
  EXPECT_NEAR(summary.energy_rotor_j, less.energy_rotor_j, 0.05 * less.energy_rotor_j);
}

TEST(Watch, at_the_goal_is_refused_in_a_hover) {
  Scenario scenario = watching(2.0, "fixed_fine");
  scenario.watch.at_goal = true;
  const auto record = fly(scenario, {});
  ASSERT_FALSE(record.ok());
  EXPECT_NE(record.error().message.find("watch.height_m = 2 must be 0 with watch.at_goal = true"),
            std::string::npos)
      << record.error().message;
}

TEST(Watch, is_refused_above_the_ceiling_and_next_to_the_ground) {
  for (const double height_m : {0.2, 9.0}) {
    const auto record = fly(watching(height_m, "fixed_fine"), {});
    ASSERT_FALSE(record.ok());
    EXPECT_NE(record.error().message.find("must be 0, to stand on the ground, or from 0.5 to 2.8"),
              std::string::npos)
        << record.error().message;
  }
}

}  // namespace
}  // namespace flyball
