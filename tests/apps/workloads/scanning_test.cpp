// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/simulation/mission.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Two lanes over 40 m x 40 m: a minute of mission time.
Scenario small_farm() {
  Scenario scenario;
  scenario.name = "small_farm";
  scenario.mission.workload = "scanning";
  scenario.mission.max_speed_m_s = 17.0;
  scenario.world.generator = "farm";
  scenario.world.parameters = {{"length_m", 40.0}, {"width_m", 40.0}, {"fields", 2.0}};
  scenario.scan.length_m = scenario.scan.width_m = 40.0;
  scenario.scan.lanes = 2;
  scenario.vehicle.payload_kg = 0.0;
  scenario.kernels.localizer = "gps";
  scenario.governor.policy = "fixed_fine";
  return scenario;
}

std::string refusal(const Scenario& scenario) {
  const auto record = fly(scenario, {});
  EXPECT_FALSE(record.ok());
  return record.ok() ? "" : record.error().message;
}

const Summary& flown() {
  static const Summary summary = fly(small_farm(), {}).value().summary;
  return summary;
}

TEST(Scanning, covers_the_area_and_comes_home) {
  EXPECT_EQ(flown().status, MissionStatus::succeeded) << to_string(flown().failure);
  EXPECT_GE(flown().quality.at("area_covered_percent"), 95.0);
  // Lanes are 20 m apart and a picture is 30 m wide.
  EXPECT_GT(flown().quality.at("overlap_percent"), 10.0);
  EXPECT_LT(flown().quality.at("overlap_percent"), 60.0);
  EXPECT_EQ(flown().replans, 1);
}

TEST(Scanning, takes_as_long_on_a_slow_computer) {
  Scenario slow = small_farm();
  slow.platform.cores = 2;
  slow.platform.frequency_hz = 806.4e6;
  const auto record = fly(slow, {});
  ASSERT_TRUE(record.ok()) << record.error().message;
  // Orders and reports between nodes take longer, some ticks of each leg; flying does not.
  EXPECT_NEAR(record->summary.mission_time_s / flown().mission_time_s, 1.0, 0.02);
  const auto planning_ms = [](const Summary& summary) {
    return summary.kernels.at("lawnmower").mission_ms_mean;
  };
  EXPECT_NEAR(planning_ms(record->summary) / planning_ms(flown()), 2035.2 / 806.4, 0.01);
}

TEST(Scanning, fails_as_incomplete_when_its_lanes_are_too_far_apart) {
  Scenario sparse = small_farm();
  sparse.scan.lanes = 1;
  sparse.scan.height_m = 10.0;
  const auto record = fly(sparse, {});
  ASSERT_TRUE(record.ok()) << record.error().message;
  EXPECT_EQ(record->summary.status, MissionStatus::failed);
  EXPECT_EQ(record->summary.failure, MissionFailure::incomplete);
  // One lane, 20 m wide, in the middle of 40 m, and a little more where it turns at the ends.
  EXPECT_GE(record->summary.quality.at("area_covered_percent"), 49.0);
  EXPECT_LE(record->summary.quality.at("area_covered_percent"), 56.0);
}

TEST(Scanning, plans_by_a_service_and_has_no_map_in_its_graph) {
  const auto graph = describe_graph(small_farm(), false);
  ASSERT_TRUE(graph.ok()) << graph.error().message;
  for (const char* name : {"localize", "coverage", "smooth", "follow", "plan.request"}) {
    EXPECT_NE(graph->find(name), std::string::npos) << name << "\n" << *graph;
  }
  EXPECT_EQ(graph->find("node map"), std::string::npos) << *graph;
  EXPECT_EQ(graph->find("cloud"), std::string::npos) << *graph;
  Scenario elsewhere = small_farm();
  elsewhere.world = {};
  EXPECT_EQ(*describe_graph(elsewhere, false), *graph);
}

TEST(Scanning, is_refused_where_nothing_is_known_to_be_clear) {
  Scenario scenario = small_farm();
  scenario.world.generator = "forest";
  scenario.world.parameters.clear();
  EXPECT_NE(refusal(scenario).find("world \"forest\" names no such height"), std::string::npos);
}

TEST(Scanning, is_refused_below_the_tree_tops_and_beyond_the_bounds) {
  Scenario low = small_farm();
  low.scan.height_m = 6.0;
  EXPECT_NE(refusal(low).find("scan.height_m = 6 m must be at least 9.5 m"), std::string::npos)
      << refusal(low);
  Scenario vague = small_farm();
  vague.scan.height_m = 9.5;
  vague.gps.wander_m = 0.5;  // Its tube of three standard deviations would reach the trees.
  EXPECT_NE(refusal(vague).find("must be at least 10.5"), std::string::npos) << refusal(vague);
  Scenario wide = small_farm();
  wide.scan.width_m = 400.0;
  EXPECT_NE(refusal(wide).find("must fit into the world's 100 m x 100 m"), std::string::npos)
      << refusal(wide);
}

}  // namespace
}  // namespace flyball
