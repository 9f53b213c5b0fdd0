// SPDX-License-Identifier: BSD-3-Clause
//
// A rule that fills its time budget must not lock itself at a crawl.

#include "flyball/governors/policy.h"
#include "flyball/scenario/plugins.h"

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

double number(const MemoryRecorder::Row& row, std::string_view name) {
  for (const Field& field : row.fields) {
    if (field.name == name) {
      const auto* value = std::get_if<double>(&field.value);
      return value == nullptr ? 0.0 : *value;
    }
  }
  return 0.0;
}

TEST(RoborunFlight, reaches_its_largest_speed_within_10_s_in_open_space) {
  if (Plugins{}.make<Policy>("roborun") == nullptr) {
    GTEST_SKIP() << "built without NLopt";
  }
  Scenario scenario = kit::short_delivery(120.0);
  scenario.governor.policy = "roborun";
  scenario.mission.max_speed_m_s = 6.0;
  scenario.mission.max_acceleration_m_s2 = 3.0;
  scenario.map.range_m = 25.0;
  scenario.camera.max_range_m = 25.0;
  scenario.camera.rgbd_noise = false;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  const MissionRecord record = kit::flown(scenario);
  ASSERT_EQ(record.summary.status, MissionStatus::succeeded);
  double begun_s = -1.0;
  double fastest_m_s = 0.0;
  for (const auto& row : record.trace->rows()) {
    const double t_s = to_seconds(row.at - MissionTime{});
    if (row.channel != "state") {
      continue;
    }
    const double speed_m_s = number(row, "set_speed_m_s");
    begun_s = begun_s < 0.0 && speed_m_s > 0.1 ? t_s : begun_s;
    if (begun_s >= 0.0 && t_s <= begun_s + 10.0) {
      fastest_m_s = std::max(fastest_m_s, speed_m_s);
    }
  }
  EXPECT_GE(fastest_m_s, 0.98 * 6.0);
}

}  // namespace
}  // namespace flyball
