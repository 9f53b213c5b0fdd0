// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/ground_coverage.h"

#include "flyball/sim/depth_camera.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

Pose at(const Vec3& p_W, double yaw_rad, double roll_rad = 0.0) {
  Pose X_WB = Pose::Identity();
  X_WB.linear() =
      (Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()} * Eigen::AngleAxisd{roll_rad, Vec3::UnitX()})
          .toRotationMatrix();
  X_WB.translation() = p_W;
  return X_WB;
}

/// Upright, 16 : 9, 90 degrees wide.
Footprint footprint(const Vec3& p_W, double yaw_rad = 0.0) {
  const auto made =
      footprint_of(downward_camera_pose(at(p_W, yaw_rad)), DepthCameraSpec{}.intrinsics(), 0.0);
  EXPECT_TRUE(made);
  return made.value_or(Footprint{});
}

Footprint square(double x_m, double y_m, double side_m) {
  return {Vec3{x_m, y_m, 0.0}, Vec3{x_m + side_m, y_m, 0.0}, Vec3{x_m + side_m, y_m + side_m, 0.0},
          Vec3{x_m, y_m + side_m, 0.0}};
}

// tan 45 degrees to each side of the way, 9 / 16 of it along.
TEST(Footprint, is_twice_as_wide_as_the_flight_is_high) {
  const Footprint seen = footprint({5.0, 7.0, 12.0});
  EXPECT_TRUE(seen[0].isApprox(Vec3{5.0 + 6.75, 7.0 + 12.0, 0.0})) << seen[0].transpose();
  EXPECT_TRUE(seen[1].isApprox(Vec3{5.0 + 6.75, 7.0 - 12.0, 0.0})) << seen[1].transpose();
  EXPECT_TRUE(seen[2].isApprox(Vec3{5.0 - 6.75, 7.0 - 12.0, 0.0})) << seen[2].transpose();
}

TEST(Footprint, turns_with_the_vehicle_and_not_with_its_roll) {
  const Footprint north = footprint({0.0, 0.0, 10.0}, 90.0 * degree);
  EXPECT_TRUE(north[0].isApprox(Vec3{-10.0, 5.625, 0.0})) << north[0].transpose();
  const Pose level = downward_camera_pose(at({0.0, 0.0, 10.0}, 0.3));
  const Pose banked = downward_camera_pose(at({0.0, 0.0, 10.0}, 0.3, 20.0 * degree));
  EXPECT_TRUE(level.isApprox(banked));
}

TEST(Footprint, does_not_exist_where_the_image_shows_the_sky) {
  const Pose up = at({0.0, 0.0, 10.0}, 0.0);  // The camera's z axis is W's: it looks up.
  EXPECT_FALSE(footprint_of(up, DepthCameraSpec{}.intrinsics(), 0.0));
}

TEST(GroundCoverage, counts_the_share_of_the_area_that_lies_in_a_picture) {
  GroundCoverage seen{{Vec3{10.0, 20.0, 0.0}, Vec3{30.0, 30.0, 0.0}}, 0.5};
  EXPECT_EQ(seen.covered_percent(), 0.0);
  EXPECT_EQ(seen.overlap_percent(), 0.0);
  seen.add(square(5.0, 15.0, 10.0));  // 5 m x 5 m of it inside
  EXPECT_NEAR(seen.covered_percent(), 100.0 * 25.0 / 200.0, 1e-9);
  seen.add(square(100.0, 100.0, 10.0));  // nothing
  EXPECT_NEAR(seen.covered_percent(), 100.0 * 25.0 / 200.0, 1e-9);
  seen.add(square(0.0, 0.0, 100.0));  // all
  EXPECT_NEAR(seen.covered_percent(), 100.0, 1e-9);
  EXPECT_EQ(seen.pictures(), 3);
}

TEST(GroundCoverage, sees_a_turned_picture_as_large_as_an_upright_one) {
  GroundCoverage seen{{Vec3{-50.0, -50.0, 0.0}, Vec3{50.0, 50.0, 0.0}}, 0.25};
  seen.add(footprint({3.0, -2.0, 16.0}, 33.0 * degree));
  const double area_m2 = 32.0 * 18.0;
  EXPECT_NEAR(seen.covered_percent(), area_m2 / 100.0, 0.02 * area_m2 / 100.0);
}

TEST(GroundCoverage, counts_as_overlap_what_comes_into_view_again_and_not_what_stays_in_it) {
  GroundCoverage seen{{Vec3{0.0, 0.0, 0.0}, Vec3{40.0, 10.0, 0.0}}, 0.5};
  for (const double x_m : {0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    seen.add(square(x_m, 0.0, 10.0));
  }
  EXPECT_NEAR(seen.covered_percent(), 100.0, 1e-9);
  EXPECT_EQ(seen.overlap_percent(), 0.0);
  seen.add(square(0.0, 0.0, 10.0));  // Back at the first place.
  EXPECT_NEAR(seen.overlap_percent(), 25.0, 1e-9);
}

TEST(GroundCoverage, writes_the_corners_of_a_picture_into_the_record) {
  const std::vector<Field> row = row_of(square(1.0, 2.0, 3.0));
  ASSERT_EQ(row.size(), 8U);
  EXPECT_EQ(row[4].name, "x2_m");
  EXPECT_EQ(std::get<double>(row[4].value), 4.0);
  EXPECT_EQ(std::get<double>(row[5].value), 5.0);
}

}  // namespace
}  // namespace flyball
