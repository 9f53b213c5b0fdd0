// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/simulation/mission.h"

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Warm from the flight before, and behind a sink on which the sun shines: at the top clock it
/// trips.
MissionRecord flown_hot(const std::string& policy, double goal_distance_m) {
  Scenario scenario = kit::short_delivery(goal_distance_m);
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = "octomap";
  scenario.governor.policy = policy;
  scenario.mission.max_speed_m_s = 2.0;
  scenario.platform.name = "jetson_tx2_passive";
  scenario.platform.start_temperature_c = 79.0;
  ComputerEvent sun;
  sun.kind = "cooling";
  sun.ambient_c = 48.0;
  sun.resistance_k_w = 10.0;
  scenario.events = {sun};
  return kit::flown(scenario);
}

double overruns_per_map(const Summary& flight) {
  return static_cast<double>(flight.bound_overruns) / static_cast<double>(flight.maps);
}

TEST(Heat, a_clock_that_reckons_with_it_is_never_throttled_where_performance_is) {
  const Summary top = flown_hot("fixed_fine", 60.0).summary;
  ASSERT_EQ(top.status, MissionStatus::succeeded);
  ASSERT_GE(top.throttle_events, 1U);
  for (const char* policy : {"fixed_fine_energy_clock", "mission_energy"}) {
    const Summary ours = flown_hot(policy, 60.0).summary;
    EXPECT_EQ(ours.status, MissionStatus::succeeded) << policy;
    EXPECT_EQ(ours.throttle_events, 0U) << policy;
    ASSERT_TRUE(ours.hottest_c);
    EXPECT_LT(*ours.hottest_c, 80.0) << policy;
    EXPECT_LE(overruns_per_map(ours), 0.07) << policy << ", asked for 5 % in some 90 maps";
  }
}

TEST(Heat, is_observed_and_recorded_where_somebody_tells_it_and_nowhere_else) {
  const auto says_trip = [](const MissionRecord& record) {
    for (const MemoryRecorder::Row& row : record.trace->rows()) {
      for (const Field& field : row.fields) {
        if (row.channel == "observation" && field.name == std::string{"trip_c"}) {
          return std::get<double>(field.value);
        }
      }
    }
    return 0.0;
  };
  EXPECT_EQ(says_trip(flown_hot("fixed_fine", 15.0)), 80.0);
  EXPECT_EQ(says_trip(kit::flown(kit::short_delivery())), 0.0);
}

}  // namespace
}  // namespace flyball
