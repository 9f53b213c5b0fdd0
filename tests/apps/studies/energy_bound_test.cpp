// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop

#include "flyball/studies/energy_bound.h"

#include "scratch_folder.h"
#include "short_delivery.h"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace flyball {
namespace {

Scenario over_open_ground(double distance_m) {
  Scenario scenario = kit::short_delivery(distance_m);
  scenario.mission.max_speed_m_s = 5.0;
  scenario.vehicle.payload_kg = 0.0;
  return scenario;
}

TEST(EnergyBound, over_open_ground_is_that_of_steady_flight) {
  const auto bound = bound_energy(over_open_ground(200.0));
  ASSERT_TRUE(bound) << bound.error().message;
  ASSERT_EQ(bound->legs.size(), 2U);
  // Eq. 1 at 5 m/s, and the TX2 idle at its lowest clock (1.4 to 2.1 W are known of it).
  const double rotor_w = 251.7 - 2.595 * 5.0;
  const double path_m = 2.0 * (200.0 / 1.0823922 - 1.0);
  EXPECT_GE(bound->energy_j(), 0.99 * path_m * (rotor_w + 1.4) / 5.0);
  EXPECT_LE(bound->energy_j(), 1.01 * path_m * (rotor_w + 2.1) / 5.0);
}

TEST(EnergyBound, of_a_vehicle_that_brakes_late_is_higher_because_it_is_slower) {
  Scenario late = over_open_ground(100.0);
  late.mission.max_speed_m_s = 10.0;
  const auto bound = bound_energy(late);
  late.vehicle.brake_lag_s = 2.0;  // Too long for 10 m/s within the longest range.
  const auto late_bound = bound_energy(late);
  ASSERT_TRUE(bound && late_bound);
  EXPECT_GT(late_bound->energy_j(), 1.05 * bound->energy_j());
}

TEST(EnergyBound, a_payload_costs_on_the_outward_flight_only) {
  Scenario loaded = over_open_ground(100.0);
  loaded.vehicle.payload_kg = 1.0;
  const auto bound = bound_energy(loaded);
  ASSERT_TRUE(bound);
  EXPECT_GT(bound->legs[0].energy_j, 1.5 * bound->legs[1].energy_j);  // .197 W a gram by eq. 1.
}

TEST(EnergyBound, loads_no_policy) {
  const ScratchFolder scratch;
  Scenario scenario = over_open_ground(50.0);
  const auto bound = bound_energy(scenario);
  scenario.governor.policy = scratch.file("theirs.so", "nothing that could be loaded");
  const auto theirs = bound_energy(scenario);
  ASSERT_TRUE(theirs) << theirs.error().message;
  EXPECT_EQ(theirs->energy_j(), bound->energy_j());
}

TEST(EnergyBound, where_the_mission_is_slow_a_metre_costs_more) {
  Scenario indoors;
  indoors.world.generator = "outdoor_to_indoor";
  indoors.world.parameters = {{"outdoors_m", 30.0}, {"indoors_m", 20.0}};
  const auto slow = bound_energy(indoors);
  indoors.world.parameters["indoor_speed_m_s"] = 10.0;
  const auto fast = bound_energy(indoors);
  ASSERT_TRUE(slow);
  ASSERT_TRUE(fast);
  // 20 m and more at 1 instead of 10 m/s, twice, at 250 W and more.
  EXPECT_GT(slow->energy_j() - fast->energy_j(), 2.0 * (15.0 - 1.5) * 250.0);
}

TEST(EnergyBound, of_a_world_that_would_take_all_memory_is_refused) {
  const ScratchFolder scratch;
  octomap::OcTree tree{10.0};
  tree.updateNode(-4005.0, -4005.0, 5.0, true);
  tree.updateNode(4005.0, 4005.0, 5.0, true);
  ASSERT_TRUE(tree.write(scratch.path("wide.ot")));
  Scenario scenario = over_open_ground(100.0);
  scenario.world.generator = "octomap_file";
  scenario.world.parameters = {{"file", scratch.path("wide.ot")}, {"pair", 0.0}};
  const auto bound = bound_energy(scenario);
  ASSERT_FALSE(bound);
  EXPECT_NE(bound.error().message.find("at most 6.25 km2"), std::string::npos)
      << bound.error().message;
}

TEST(EnergyBound, is_below_every_flight_that_succeeds) {
  for (const char* model : {"regression", "thrust"}) {
    for (const char* policy : {"fixed_coarse", "mission_energy"}) {
      Scenario scenario = kit::short_delivery(40.0);
      scenario.governor.policy = policy;
      scenario.vehicle.rotor_power = model;
      scenario.camera.width_px = 64;
      scenario.camera.height_px = 36;
      const Summary flown = kit::flown(scenario).summary;
      ASSERT_EQ(flown.status, MissionStatus::succeeded) << policy;
      const auto bound = bound_energy(scenario);
      ASSERT_TRUE(bound);
      EXPECT_LT(bound->energy_j(), flown.energy_total_j()) << policy << ", " << model;
      EXPECT_GT(bound->energy_j(), 0.1 * flown.energy_total_j()) << policy << ", " << model;
    }
  }
}

TEST(EnergyBound, is_below_a_flight_among_trees) {
  Scenario scenario;
  scenario.name = "short_forest";
  scenario.world.generator = "forest";
  scenario.world.parameters = {{"goal_distance_m", 30.0}, {"width_m", 20.0}};
  scenario.governor.policy = "fixed_coarse";
  scenario.mission.time_limit_s = 240.0;
  scenario.camera.width_px = 64;
  scenario.camera.height_px = 36;
  const Summary flown = kit::flown(scenario).summary;
  ASSERT_EQ(flown.status, MissionStatus::succeeded);
  const auto bound = bound_energy(scenario);
  ASSERT_TRUE(bound) << bound.error().message;
  EXPECT_LT(bound->energy_j(), flown.energy_total_j());
}

TEST(EnergyBound, is_refused_where_it_is_not_known) {
  Scenario gusts = over_open_ground(50.0);
  gusts.vehicle.gust_wind_m_s = 10.0;
  EXPECT_FALSE(bound_energy(gusts));
  Scenario other = over_open_ground(50.0);
  other.mission.workload = "scanning";
  EXPECT_FALSE(bound_energy(other));
}

}  // namespace
}  // namespace flyball
