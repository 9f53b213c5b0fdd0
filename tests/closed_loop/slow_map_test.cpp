// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
//
// Frames that take seconds come from few places: a vehicle that used up what was declared clear at
// its start before its first map came would stand too near to what it does not know to see it. So
// it waits for that map.

#include "flyball/runtime/observation_fields.h"

#include "short_delivery.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using Row = MemoryRecorder::Row;

constexpr auto observation_lag = 300ms;  // A map is observed at the next look around.

double number(const Row& row, const std::string& name) {
  for (const Field& field : row.fields) {
    if (field.name == name && std::holds_alternative<double>(field.value)) {
      return std::get<double>(field.value);
    }
  }
  return 0.0;
}

bool is_cruising(const Row& row) {
  return std::any_of(row.fields.begin(), row.fields.end(), [](const Field& field) {
    const auto* text = std::get_if<std::string>(&field.value);
    return text != nullptr && *text == to_string(MissionPhase::cruise);
  });
}

MissionTime first_map_seen(const MemoryRecorder& trace) {
  for (const auto& row : trace.rows()) {
    if (row.channel == "observation" && number(row, "map_revision") >= 1.0) {
      return row.at;
    }
  }
  return MissionTime{};
}

TEST(SlowMap, does_not_let_the_vehicle_set_out_blind_nor_hold_it_at_its_start) {
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
  const auto first_map = first_map_seen(*record.trace);
  int looks = 0;
  for (const auto& row : record.trace->rows()) {
    if (row.channel == "state" && row.at + observation_lag < first_map && is_cruising(row)) {
      EXPECT_EQ(number(row, "set_speed_m_s"), 0.0) << "it set out before it had a map";
      ++looks;
    }
  }
  EXPECT_GE(looks, 10) << "the test shows nothing: its first map was there at once";
}

}  // namespace
}  // namespace flyball
