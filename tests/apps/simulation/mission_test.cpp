// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/mission.h"

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Mission, ends_as_time_limit_when_the_time_is_over) {
  Scenario scenario = kit::short_delivery(200.0);
  scenario.mission.time_limit_s = 3.0;
  const Summary summary = kit::flown(scenario).summary;
  EXPECT_EQ(summary.status, MissionStatus::failed);
  EXPECT_EQ(summary.failure, MissionFailure::time_limit);
  EXPECT_NEAR(summary.mission_time_s, 3.0, 0.02);
}

TEST(Mission, ends_as_battery_empty_when_the_battery_is) {
  Scenario scenario = kit::short_delivery(200.0);
  scenario.vehicle.battery_charge = 0.012;
  const Summary summary = kit::flown(scenario).summary;
  EXPECT_EQ(summary.failure, MissionFailure::battery_empty);
  EXPECT_LT(summary.battery_end_percent, 1.2);
}

TEST(Mission, is_interrupted_when_asked_to_stop) {
  int asked = 0;
  MissionHooks hooks;
  hooks.stop = [&] { return ++asked > 2000; };
  const auto record = fly(kit::short_delivery(), hooks);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(record->summary.status, MissionStatus::interrupted);
}

TEST(Mission, an_unknown_workload_is_an_error_with_the_way_out) {
  Scenario scenario;
  scenario.mission.workload = "laundry";
  const auto record = fly(scenario, {});
  ASSERT_FALSE(record.ok());
  EXPECT_NE(record.error().message.find("flyball list workloads"), std::string::npos);
}

TEST(Mission, graph_is_described_as_text_and_for_graphviz) {
  const auto text = describe_graph(Scenario{}, false);
  const auto dot = describe_graph(Scenario{}, true);
  ASSERT_TRUE(text.ok() && dot.ok());
  for (const char* node : {"points", "map", "check", "plan", "smooth", "follow", "mission"}) {
    EXPECT_NE(text->find(node), std::string::npos) << node;
    EXPECT_NE(dot->find(node), std::string::npos) << node;
  }
  EXPECT_EQ(dot->rfind("digraph", 0), 0U);
}

}  // namespace
}  // namespace flyball
