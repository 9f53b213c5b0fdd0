// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop

#include "simulation/computer_drift.h"

#include "flyball/simulation/mission.h"

#include "short_delivery.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Scenario drifting() {
  Scenario scenario = kit::short_delivery();
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = "octomap";
  scenario.governor.policy = "fixed_fine";
  scenario.map.resolution_m = 0.6;
  scenario.platform.name = "jetson_tx2_passive";
  scenario.platform.start_temperature_c = 79.9;
  ComputerEvent slow;
  slow.kind = "slowdown";
  slow.at_s = 4.0;
  slow.factor = 3.0;
  ComputerEvent calm;
  calm.kind = "cooling";
  calm.at_s = 3.0;
  calm.until_s = 20.0;
  calm.ambient_c = 45.0;
  calm.resistance_k_w = 200.0;
  scenario.events = {slow, calm};
  return scenario;
}

std::vector<std::string> events_of(const MissionRecord& record) {
  std::vector<std::string> events;
  for (const MemoryRecorder::Row& row : record.trace->rows()) {
    if (row.channel == "event") {
      events.push_back(std::get<std::string>(row.fields.front().value));
    }
  }
  return events;
}

bool has(const std::vector<std::string>& events, const std::string& beginning) {
  return std::any_of(events.begin(), events.end(),
                     [&](const std::string& event) { return event.rfind(beginning, 0) == 0; });
}

TEST(ComputerDrift, every_change_is_an_event_of_the_record_and_nothing_collides) {
  const MissionRecord record = kit::flown(drifting());
  const std::vector<std::string> events = events_of(record);
  for (const char* what : {"slowdown: 3 times", "cooling: 200 K/W", "cooling ends",
                           "throttled to 1.421 GHz at 80.0", "fallback table"}) {
    EXPECT_TRUE(has(events, what)) << what;
  }
  EXPECT_NE(record.summary.failure, MissionFailure::collision);
  EXPECT_GE(record.summary.throttle_events, 1U);
  ASSERT_TRUE(record.summary.hottest_c);
  EXPECT_GT(*record.summary.hottest_c, 80.0);
}

TEST(ComputerDrift, is_a_function_of_the_scenario) {
  EXPECT_EQ(kit::flown(drifting()).summary.trace_hash, kit::flown(drifting()).summary.trace_hash);
}

TEST(ComputerDrift, a_slowdown_is_seen_in_the_kernels_times) {
  Scenario calm = kit::short_delivery();
  Scenario slow = calm;
  ComputerEvent event;
  event.kind = "slowdown";
  event.factor = 3.0;
  event.kernels = "swept_cylinder";
  slow.events = {event};
  const auto time_ms = [](const Scenario& scenario) {
    return kit::flown(scenario).summary.kernels.at("swept_cylinder").mission_ms_mean;
  };
  EXPECT_GT(time_ms(slow), 2.0 * time_ms(calm));
}

TEST(ComputerDrift, nothing_is_said_of_heat_where_nothing_is_known) {
  const MissionRecord record = kit::flown(kit::short_delivery());
  EXPECT_FALSE(record.summary.hottest_c);
  EXPECT_EQ(record.summary.throttle_events, 0U);
}

}  // namespace
}  // namespace flyball
