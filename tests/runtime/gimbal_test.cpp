// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/gimbal.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(GimbalAngles, look_ahead_at_rest_to_the_left_when_panned_and_down_when_tilted) {
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
