// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
//
// Localizers with cameras, and detectors, each exchanged by one setting in a mission that needs it.

#include "flyball/simulation/mission.h"

#include "models.h"
#include <filesystem>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// The first views in an office of two rooms and a corridor.
Scenario small_office() {
  Scenario scenario;
  scenario.name = "small_office";
  scenario.mission.workload = "mapping";
  scenario.mission.time_limit_s = 300.0;
  scenario.world.generator = "office";
  scenario.world.parameters = {{"rooms_per_side", 1.0}, {"furniture_per_room", 1.0}};
  scenario.vehicle.payload_kg = 0.0;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["cost_of"] = std::string{"octomap"};
  scenario.explore.coverage_percent = 15.0;
  return scenario;
}

class ExchangedLocalizer : public testing::TestWithParam<const char*> {};

TEST_P(ExchangedLocalizer, maps_rooms_by_what_it_sees) {
  Scenario scenario = small_office();
  scenario.kernels.localizer = GetParam();
  const auto record = fly(scenario, {});
  ASSERT_TRUE(record) << record.error().message;
  const Summary& summary = record->summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_GT(summary.kernels.at(std::string{GetParam()} + "_frames").calls, 20U);
  EXPECT_GT(summary.quality.at("localization_error_m_mean"), 0.0);
  EXPECT_LT(summary.quality.at("localization_error_m_max"), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Eyes,
                         ExchangedLocalizer,
                         testing::Values("visual_slam", "visual_inertial"),
                         [](const auto& one) { return std::string{one.param}; });

Result<MissionRecord> photograph_with(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"photography.limit_s=4", "photography.success_s=3",
                                   "photography.lost_after_detections=3"});
  auto loaded = load_scenario("photography_park", settings);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return errors->front();
  }
  return fly(std::get<LoadedScenario>(loaded).scenario, {});
}

TEST(ExchangedDetector, yolo_keeps_a_person_in_view) {
  const auto weights = find_test_model("yolo-fastest-1.1.weights");
  if (!weights) {
    GTEST_SKIP() << weights.error().message;
  }
  const std::string folder = std::filesystem::path{*weights}.parent_path().string();
  const auto record =
      photograph_with({"kernels.detector=yolo", "detector.models_folder=" + folder});
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_EQ(record->summary.status, MissionStatus::succeeded) << to_string(record->summary.failure);
  EXPECT_GT(record->summary.kernels.at("yolo").calls, 3U);
}

/// It sees one person in ten at this distance: that it looks and is charged is all that is asked.
TEST(ExchangedDetector, haar_looks_until_it_gives_up_or_succeeds) {
  const auto record = photograph_with({"kernels.detector=haar", "detector.scale=1"});
  if (!record && record.error().code == ErrorCode::not_found) {
    GTEST_SKIP() << record.error().message;
  }
  ASSERT_TRUE(record) << record.error().message;
  const Summary& summary = record->summary;
  EXPECT_TRUE(summary.status == MissionStatus::succeeded ||
              summary.failure == MissionFailure::target_lost)
      << to_string(summary.failure);
  EXPECT_GE(summary.kernels.at("haar").calls, 3U);
  EXPECT_GT(summary.kernels.at("haar").mission_ms_mean, 0.0);
}

}  // namespace
}  // namespace flyball
