// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/simulation/mission.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// One cross wall, and nothing fallen.
Scenario small_search() {
  Scenario scenario;
  scenario.name = "small_search";
  scenario.mission.workload = "search_and_rescue";
  scenario.world.generator = "collapsed_building";
  scenario.world.parameters = {{"length_m", 9.0}, {"width_m", 6.0}, {"walls", 1.0},
                               {"slabs", 0.0},    {"rubble", 0.0},  {"hole_m", 2.0}};
  scenario.vehicle.payload_kg = 0.0;
  scenario.colour_camera.rate_hz = 2.0;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  scenario.mission.time_limit_s = 600.0;
  return scenario;
}

TEST(SearchAndRescue, finds_the_person_who_is_there_and_comes_home) {
  const auto record = fly(small_search(), {});
  ASSERT_TRUE(record) << record.error().message;
  const Summary& summary = record->summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_LE(summary.quality.at("position_error_m"), 1.0);
  EXPECT_LT(summary.quality.at("time_to_find_s"), summary.mission_time_s);
  EXPECT_GE(summary.kernels.at("hog").calls, 1U);
  ASSERT_FALSE(record->frames.empty());
  EXPECT_NE(record->frames.back().caption.find("the person"), std::string::npos);
}

}  // namespace
}  // namespace flyball
