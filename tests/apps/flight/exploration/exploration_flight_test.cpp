// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/exploration_flight.h"

#include "mission_rig.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(ExploreRequest, has_the_field_of_the_camera_and_the_slow_bodys_tube) {
  const kit::GridMap map{{{0, 0, 0}, {3, 3, 3}}, 0.15};
  const kit::MissionRig rig{map};
  const ExploreRequest request = explore_request(*rig.brief, {{1, 2, 1}, 0.5});
  EXPECT_NEAR(request.field.horizontal_rad, rig.scenario.camera.horizontal_field_rad, 1e-9);
  EXPECT_NEAR(std::tan(0.5 * request.field.vertical_rad), 144.0 / 256.0, 1e-9);
  EXPECT_EQ(request.field.range_m, rig.scenario.explore.gain_range_m);
  EXPECT_GT(request.body.radius_m, 0.325);
  EXPECT_EQ(request.from.yaw_rad, 0.5);
}

TEST(CheckVolume, refuses_a_world_without_anything_to_explore) {
  Site brief;
  EXPECT_FALSE(check_volume(brief));
  brief.volume_W = {{0, 0, 0}, {10, 10, 0}};
  EXPECT_FALSE(check_volume(brief));
  brief.volume_W.max.z() = 3.0;
  EXPECT_TRUE(check_volume(brief));
}

}  // namespace
}  // namespace flyball
