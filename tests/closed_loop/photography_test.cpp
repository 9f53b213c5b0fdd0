// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/simulation/mission.h"

#include <variant>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Result<MissionRecord> photograph(std::vector<std::string> settings) {
  // Short: the vehicle is up after 5 s, the person walks from second 12 on.
  settings.insert(settings.end(), {"photography.limit_s=12", "photography.success_s=10"});
  auto loaded = load_scenario("photography_park", settings);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return errors->front();
  }
  return fly(std::get<LoadedScenario>(loaded).scenario, {});
}

TEST(Photography, follows_the_person_and_does_the_same_again) {
  const auto first = photograph({});
  if (!first && first.error().message.find("morse-simulator-data") != std::string::npos) {
    GTEST_SKIP() << first.error().message;
  }
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_EQ(first->summary.status, MissionStatus::succeeded);
  EXPECT_GE(first->summary.quality.at("tracked_s"), 12.0);
  EXPECT_EQ(first->summary.quality.at("is_censored"), 1.0);
  EXPECT_LT(first->summary.quality.at("wrong_box_percent"), 5.0);
  EXPECT_FALSE(first->frames.empty());
  const auto second = photograph({});
  EXPECT_EQ(second->summary.trace_hash, first->summary.trace_hash);
}

TEST(Photography, loses_nobody_it_never_found) {
  const auto record = photograph({"colour_camera.width_px=32", "colour_camera.height_px=24",
                                  "photography.lost_after_detections=5"});
  if (!record) {
    GTEST_SKIP() << record.error().message;
  }
  EXPECT_EQ(record->summary.failure, MissionFailure::target_lost);
  EXPECT_EQ(record->summary.quality.at("tracked_s"), 0.0);
}

TEST(Photography, is_refused_where_it_would_end_before_it_can_succeed) {
  Scenario scenario;
  scenario.mission.workload = "aerial_photography";
  scenario.photography.limit_s = 30.0;
  const auto record = fly(scenario, {});
  ASSERT_FALSE(record.ok());
  EXPECT_EQ(record.error().message,
            "photography.limit_s = 30 s would end the mission before photography.success_s = 60 s; "
            "make it that long at least");
}

}  // namespace
}  // namespace flyball
