// SPDX-License-Identifier: BSD-3-Clause
//
// A rule that likes coarse cells must not stand for ever before a gap that they close.

#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// 50 m with one wall across, 3 m deep, and a slit of .9 to 1.5 m in it.
Scenario before_a_slit(std::uint64_t seed) {
  Scenario scenario = kit::short_delivery();
  scenario.seed = seed;
  scenario.world.generator = "mixed";
  scenario.world.parameters = {
      {"length_m", 50.0}, {"buildings", -1.0}, {"crowds", 0.0}, {"slits", 1.0}};
  scenario.governor.policy = "mission_energy";
  scenario.mission.max_speed_m_s = 6.0;
  scenario.mission.max_acceleration_m_s2 = 3.0;
  scenario.mission.time_limit_s = 150.0;
  scenario.map.range_m = 25.0;
  scenario.camera.max_range_m = 25.0;
  scenario.camera.rgbd_noise = false;
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  return scenario;
}

class NarrowPaths : public testing::TestWithParam<std::uint64_t> {};

TEST_P(NarrowPaths, are_passed_there_and_back) {
  const Summary summary = kit::flown(before_a_slit(GetParam())).summary;
  EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure);
  EXPECT_GT(summary.min_clearance_m, 0.0);
  // 100 m at half of the least speed that the finest cells allow, and a look around at each end.
  EXPECT_LT(summary.mission_time_s, 100.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, NarrowPaths, testing::Values(1, 2));

}  // namespace
}  // namespace flyball
