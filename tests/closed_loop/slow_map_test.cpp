// SPDX-License-Identifier: BSD-3-Clause
//
// Frames that take seconds come from few places: a vehicle that has used up what was declared clear
// at its start stands too near to what it does not know to see it.

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(SlowMap, does_not_hold_the_vehicle_at_its_start) {
  Scenario scenario = kit::short_delivery();
  scenario.world.generator = "congestion";
  scenario.world.parameters = {{"goal_m", 30.0}};
  scenario.seed = 1;
  scenario.governor.policy = "fixed_worst_case";  // .3 m and 25 m ...
  scenario.platform.name = "roborun";             // ... in five seconds a frame.
  scenario.camera.max_range_m = 25.0;
  scenario.camera.rgbd_noise = false;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  scenario.vehicle.physics_step_s = 0.004;
  scenario.mission.time_limit_s = 300.0;
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded) << to_string(record.summary.failure);
  EXPECT_GT(record.summary.latency_p50_s, 3.0) << "the test is about slow maps";
  int times_back = 0;
  for (const auto& row : record.trace->rows()) {
    for (const Field& field : row.fields) {
      const auto* text = std::get_if<std::string>(&field.value);
      const bool is_event = row.channel == "event" && text != nullptr;
      times_back += is_event && text->find("steps back") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_GE(times_back, 1) << "the test shows nothing: it got away without";
}

}  // namespace
}  // namespace flyball
