// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/realtime_flight.h"

#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(RealtimeFlight, flies_the_nodes_of_a_mission_on_threads_as_time_passes) {
  // A small camera, so that maps are made in time on a slow machine under a sanitizer as well.
  auto found = load_scenario(
      "delivery_forest", {"mission.time_limit_s=6", "camera.width_px=32", "camera.height_px=18",
                          "platform.name=jetson_tx2_passive", "platform.start_temperature_c=85"});
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(found));
  MissionHooks hooks;
  hooks.executor = in_real_time({});
  const auto record = fly(std::get<LoadedScenario>(found).scenario, hooks);
  ASSERT_TRUE(record) << record.error().message;
  const Summary& summary = record->summary;
  EXPECT_EQ(summary.failure, MissionFailure::time_limit);
  EXPECT_GE(summary.host_s, summary.mission_time_s);
  EXPECT_GT(summary.maps, 0U);
  EXPECT_GT(summary.decisions, 0U);
  EXPECT_GT(summary.latency_p50_s, 0.0);
  EXPECT_GT(summary.energy_computer_j, 0.0);
  EXPECT_EQ(summary.quality.count("simulator_late_s_max"), 1U);
  EXPECT_FALSE(summary.kernels.empty());
  EXPECT_FALSE(summary.hottest_c) << "the heat of a model says nothing about this computer";
  EXPECT_EQ(summary.throttle_events, 0U);
  EXPECT_NE(record->knobs.spec("map.resolution_m"), nullptr) << "the page shows the knobs as well";
}

}  // namespace
}  // namespace flyball
