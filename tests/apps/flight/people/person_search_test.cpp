// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/person_search.h"

#include "flyball/sim/gimbal.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A wall at a distance, as a level camera of 90 degrees sees it.
DepthImage wall_ahead(float distance_m) {
  DepthImage image;
  image.camera = {64, 48, 32.0, 31.5, 23.5};
  image.max_range_m = 20.0;
  image.depth_m.assign(64U * 48U, distance_m);
  return image;
}

ColourFrame frame_at(const GimbalAngles& angles) {
  ColourFrame frame;
  frame.camera = {100, 80, 90.0, 49.5, 39.5};
  frame.X_LC = camera_in_level_frame(angles);
  return frame;
}

Pose body_at(const Vec3& p_W, double yaw_rad) {
  Pose X_WB = Pose::Identity();
  X_WB.linear() = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix();
  X_WB.translation() = p_W;
  return X_WB;
}

TEST(PlaceOf, a_box_in_the_middle_is_straight_ahead_at_the_depth_there) {
  const auto place = place_of({44.5, 29.5, 10, 20}, frame_at({}), wall_ahead(4.0F), {},
                              body_at({1.0, 2.0, 1.5}, 1.5707963267948966));
  ASSERT_TRUE(place);
  EXPECT_LT((*place - Vec3{1.0, 6.0, 1.5}).norm(), 0.05) << place->transpose();
}

TEST(PlaceOf, a_box_beside_the_middle_is_to_that_side) {
  // 45 px right of the middle at a focal length of 90: half a metre for each metre ahead.
  const auto place = place_of({89.5, 29.5, 10, 20}, frame_at({}), wall_ahead(4.0F), {},
                              body_at(Vec3::Zero(), 0.0));
  ASSERT_TRUE(place);
  EXPECT_LT((*place - Vec3{4.0, -2.0, 0.0}).norm(), 0.05) << place->transpose();
}

TEST(PlaceOf, goes_by_where_the_gimbal_held_the_camera) {
  const auto place = place_of({44.5, 29.5, 10, 20}, frame_at({0.4, 0.0}), wall_ahead(4.0F), {},
                              body_at(Vec3::Zero(), 0.0));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x(), 4.0, 0.05);
  EXPECT_NEAR(place->y(), 4.0 * std::tan(0.4), 0.05);
}

TEST(PlaceOf, goes_by_how_the_depth_camera_is_mounted) {
  DepthCameraSpec mount;
  mount.pitch_down_rad = 0.35;
  mount.forward_m = 0.2;
  mount.up_m = 0.1;
  // A floor 1.1 m below that camera, as it sees it: a level line of sight never meets it, and one
  // that goes down by 1 in 4 does 4.4 m ahead.
  DepthImage floor = wall_ahead(0.0F);
  for (int v = 0; v < floor.camera.height_px; ++v) {
    const double down = std::tan(0.35 + std::atan((v - floor.camera.centre_y_px) / 32.0));
    for (int u = 0; u < floor.camera.width_px; ++u) {
      const double along = std::cos(0.35) + std::sin(0.35) * down;  // Depth of a metre ahead.
      floor.depth_m[static_cast<std::size_t>(v * floor.camera.width_px + u)] =
          down > 0.05 ? static_cast<float>(1.1 / down * along) : 0.0F;
    }
  }
  const auto place = place_of({44.5, 29.5, 10, 20}, frame_at({0.0, std::atan(0.25)}), floor, mount,
                              body_at({0.0, 0.0, 1.0}, 0.0));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x(), 4.6, 0.15);
  EXPECT_NEAR(place->z(), 0.0, 0.05);
}

TEST(PlaceOf, is_the_median_depth_so_that_a_gap_in_the_person_does_not_matter) {
  DepthImage image = wall_ahead(4.0F);
  for (std::size_t i = 0; i < image.depth_m.size(); i += 3) {
    image.depth_m[i] = 12.0F;
  }
  const auto place =
      place_of({29.5, 19.5, 40, 40}, frame_at({}), image, {}, body_at(Vec3::Zero(), 0.0));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x(), 4.0, 0.05);
}

TEST(PlaceOf, is_nowhere_without_a_depth) {
  const auto infinite = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(place_of({44.5, 29.5, 10, 20}, frame_at({}), wall_ahead(infinite), {},
                        body_at(Vec3::Zero(), 0.0)));
  EXPECT_FALSE(place_of({44.5, 29.5, 10, 20}, frame_at({}), wall_ahead(0.0F), {},
                        body_at(Vec3::Zero(), 0.0)));
  EXPECT_FALSE(place_of({44.5, 29.5, 10, 20}, frame_at({1.0, 0.0}), wall_ahead(4.0F), {},
                        body_at(Vec3::Zero(), 0.0)))
      << "out of the depth camera's field";
}

}  // namespace
}  // namespace flyball
