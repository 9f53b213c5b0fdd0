// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
// test-label: closed_loop
#include "flyball/simulation/mission.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Two rooms on a corridor of 5 m.
Scenario small_office() {
  Scenario scenario;
  scenario.name = "small_office";
  scenario.mission.workload = "mapping";
  scenario.world.generator = "office";
  scenario.world.parameters["rooms_per_side"] = 1.0;
  scenario.vehicle.payload_kg = 0.0;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  scenario.mission.time_limit_s = 600.0;
  scenario.explore.coverage_percent = 70.0;
  return scenario;
}

TEST(Mapping, covers_what_was_asked_for_comes_home_and_its_map_fits_the_world) {
  const auto record = fly(small_office(), {});
  ASSERT_TRUE(record) << record.error().message;
  const Summary& summary = record->summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_GE(summary.quality.at("coverage_percent"), 70.0);
  EXPECT_GE(summary.quality.at("map_precision"), 0.9);
  EXPECT_GT(summary.kernels.at("nbvp").calls, 1U);
}

TEST(Mapping, finds_its_first_view_sooner_with_several_threads_where_cores_are_idle) {
  const auto first_view_ms = [](int threads) {
    Scenario scenario = small_office();
    scenario.explore.threads = threads;
    scenario.mission.time_limit_s = 6.0;
    const auto record = fly(scenario, {});
    FLYBALL_ASSERT(record.ok(), "%d threads", threads);
    const auto& explorer = record->summary.kernels.at("nbvp");
    FLYBALL_ASSERT(explorer.calls == 1U, "%d threads", threads);
    return explorer.mission_ms_mean;
  };
  const double alone_ms = first_view_ms(1);
  EXPECT_LT(first_view_ms(4), 0.75 * alone_ms);
}

TEST(Mapping, is_refused_where_there_is_no_volume) {
  Scenario scenario;
  scenario.mission.workload = "mapping";
  const auto record = fly(scenario, {});
  ASSERT_FALSE(record);
  EXPECT_NE(record.error().message.find("volume"), std::string::npos);
}

}  // namespace
}  // namespace flyball
