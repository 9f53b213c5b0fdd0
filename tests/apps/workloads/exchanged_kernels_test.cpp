// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
//
// Each planner and smoother flies a delivery between trees: exchanging one is a word in the
// scenario.

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Scenario between_trees() {
  Scenario scenario = kit::short_delivery();
  scenario.world.generator = "forest";
  scenario.world.parameters = {{"goal_distance_m", 20.0},
                               {"width_m", 10.0},
                               {"density_1_m2", 0.07},
                               {"clear_radius_m", 2.0}};
  return scenario;
}

/// Of all plans of a mission.
double iterations(const MissionRecord& record) {
  double sum = 0.0;
  for (const auto& row : record.trace->rows()) {
    for (const Field& field : row.fields) {
      sum +=
          row.channel == "plan" && field.name == "iterations" ? std::get<double>(field.value) : 0.0;
    }
  }
  return sum;
}

class ExchangedPlanner : public testing::TestWithParam<const char*> {};

TEST_P(ExchangedPlanner, delivers_there_and_back) {
  Scenario scenario = between_trees();
  scenario.kernels.planner = GetParam();
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded) << to_string(record.summary.failure);
  EXPECT_GT(record.summary.kernels.at(GetParam()).mission_ms_mean, 0.0);
  EXPECT_GT(iterations(record), 0.0) << "the way was straight";
}

INSTANTIATE_TEST_SUITE_P(Planners,
                         ExchangedPlanner,
                         testing::Values("bit_star", "prm", "rrt", "rrt_star"),
                         [](const auto& one) { return std::string{one.param}; });

TEST(ExchangedSmoother, delivers_with_minimum_jerk) {
  Scenario scenario = between_trees();
  scenario.kernels.smoother = "minimum_jerk";
  const MissionRecord record = kit::flown(scenario);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded) << to_string(record.summary.failure);
  EXPECT_GT(record.summary.kernels.at("minimum_jerk").calls, 1U);
}

TEST(ExchangedCameras, delivers_with_six_around) {
  Scenario one = between_trees();
  Scenario six = one;
  six.camera.count = 6;
  six.camera.horizontal_field_rad = 1.1;
  const MissionRecord record = kit::flown(six);
  EXPECT_EQ(record.summary.status, MissionStatus::succeeded) << to_string(record.summary.failure);
  EXPECT_NEAR(record.summary.kernels.at("depth_to_points").mission_ms_mean,
              6.0 * kit::flown(one).summary.kernels.at("depth_to_points").mission_ms_mean, 1.0);
}

TEST(ExchangedWeather, delivers_in_light_gusts) {
  Scenario calm = kit::short_delivery();
  Scenario gusty = calm;
  gusty.vehicle.gust_wind_m_s = 7.7;  // Light turbulence.
  const Summary in_gusts = kit::flown(gusty).summary;
  EXPECT_EQ(in_gusts.status, MissionStatus::succeeded) << to_string(in_gusts.failure);
  EXPECT_NE(kit::flown(calm).summary.trace_hash, in_gusts.trace_hash);
}

}  // namespace
}  // namespace flyball
