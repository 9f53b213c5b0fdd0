// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/gimbal.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Gimbal, turns_no_faster_than_its_rate_and_arrives) {
  Gimbal gimbal;
  gimbal.aim({0.4, 1.2});
  gimbal.step(0.1);
  EXPECT_NEAR(gimbal.angles().pan_rad, 0.15708, 1e-4);
  EXPECT_NEAR(gimbal.angles().tilt_rad, 0.15708, 1e-4);
  for (int i = 0; i < 20; ++i) {
    gimbal.step(0.1);
  }
  EXPECT_DOUBLE_EQ(gimbal.angles().pan_rad, 0.4);
  EXPECT_DOUBLE_EQ(gimbal.angles().tilt_rad, 1.2);
}

TEST(Gimbal, goes_to_its_stops_and_ignores_a_command_that_is_none) {
  const GimbalSpec spec;
  Gimbal gimbal;
  gimbal.aim({-9.0, 9.0});
  gimbal.step(10.0);
  EXPECT_DOUBLE_EQ(gimbal.angles().pan_rad, -spec.max_pan_rad);
  EXPECT_DOUBLE_EQ(gimbal.angles().tilt_rad, spec.max_tilt_rad);
  gimbal.aim({std::numeric_limits<double>::quiet_NaN(), 0.0});
  gimbal.step(10.0);
  EXPECT_DOUBLE_EQ(gimbal.angles().tilt_rad, spec.max_tilt_rad);
}

TEST(Gimbal, looks_ahead_at_rest_to_the_left_when_panned_and_down_when_tilted) {
  const auto forward = [](const GimbalAngles& angles) {
    return Vec3{camera_in_level_frame(angles).linear().col(2)};
  };
  EXPECT_TRUE(forward({}).isApprox(Vec3::UnitX()));
  EXPECT_GT(forward({0.3, 0.0}).y(), 0.2);
  EXPECT_LT(forward({0.0, 0.3}).z(), -0.2);
  const Vec3 right = camera_in_level_frame({0.3, 0.3}).linear().col(0);
  EXPECT_NEAR(right.z(), 0.0, 1e-12);  // The horizon stays level.
}

TEST(LevelFrame, has_the_bodys_origin_and_heading_and_stands_upright) {
  Pose X_WB = Pose::Identity();
  X_WB.linear() = (Eigen::AngleAxisd{0.8, Vec3::UnitZ()} * Eigen::AngleAxisd{0.4, Vec3::UnitY()} *
                   Eigen::AngleAxisd{-0.3, Vec3::UnitX()})
                      .toRotationMatrix();
  X_WB.translation() = Vec3{1.0, 2.0, 3.0};
  const Pose X_WL = level_frame(X_WB);
  EXPECT_TRUE(X_WL.translation().isApprox(X_WB.translation()));
  EXPECT_TRUE(X_WL.linear().col(2).isApprox(Vec3::UnitZ()));
  EXPECT_NEAR(yaw_of(X_WL.linear().col(0)), 0.8, 1e-12);
}

}  // namespace
}  // namespace flyball
