// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/gimbal.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Eigen::Matrix3d leaning(double yaw_rad, double pitch_rad, double roll_rad) {
  return (Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()} * Eigen::AngleAxisd{pitch_rad, Vec3::UnitY()} *
          Eigen::AngleAxisd{roll_rad, Vec3::UnitX()})
      .toRotationMatrix();
}

TEST(GimbalServo, wants_joints_that_hold_the_axis_where_it_was_told_whatever_the_body_does) {
  GimbalServo servo{{}};
  const GimbalAngles told{0.4, 0.6};
  servo.aim(told);
  servo.slew(1.0);
  const GimbalAngles upright = servo.wanted_joints(Eigen::Matrix3d::Identity(), {});
  EXPECT_NEAR(upright.pan_rad, told.pan_rad, 1e-12);
  EXPECT_NEAR(upright.tilt_rad, told.tilt_rad, 1e-12);
  Pose X_WB = Pose::Identity();
  X_WB.linear() = leaning(2.0, 0.3, -0.2);
  const GimbalAngles joints = servo.wanted_joints(X_WB.linear(), {});
  const Vec3 axis_W = X_WB.linear() * camera_in_level_frame(joints).linear().col(2);
  const Vec3 told_W = level_frame(X_WB).linear() * camera_in_level_frame(told).linear().col(2);
  EXPECT_TRUE(axis_W.isApprox(told_W, 1e-12));
}

TEST(GimbalServo, goes_to_its_stops_and_ignores_a_command_that_is_none) {
  const GimbalSpec spec;
  GimbalServo servo{spec};
  servo.aim({-9.0, 0.2});
  servo.slew(10.0);
  const auto wanted = [&] { return servo.wanted_joints(Eigen::Matrix3d::Identity(), {}); };
  EXPECT_DOUBLE_EQ(wanted().pan_rad, -spec.max_pan_rad);
  servo.aim({std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_NEAR(wanted().tilt_rad, 0.2, 1e-12);
  servo.slew(10.0);
  servo.aim({0.0, 0.2});  // A body that leans over: the joints have their stops, too.
  servo.slew(10.0);
  const GimbalAngles nose_down = servo.wanted_joints(leaning(0.0, 1.2, 0.0), {});
  EXPECT_DOUBLE_EQ(nose_down.tilt_rad, spec.min_tilt_rad);
}

TEST(GimbalServo, straight_down_it_keeps_its_pan) {
  GimbalServo servo{{}};
  servo.aim({0.0, 1.5707963267948966});
  servo.slew(10.0);
  const GimbalAngles wanted = servo.wanted_joints(leaning(0.0, 0.0, 0.01), {0.3, 1.5});
  EXPECT_DOUBLE_EQ(wanted.pan_rad, 0.3);
}

TEST(GimbalServo, looks_elsewhere_no_faster_than_its_rate) {
  const GimbalSpec spec;
  GimbalServo servo{spec};
  servo.aim({0.9, -0.1});
  servo.slew(0.1);
  const GimbalAngles wanted = servo.wanted_joints(Eigen::Matrix3d::Identity(), {});
  EXPECT_NEAR(wanted.pan_rad, 0.1 * spec.max_rate_rad_s, 1e-12);
  EXPECT_NEAR(wanted.tilt_rad, -0.1, 1e-12);
  EXPECT_GT(servo.acceleration(Eigen::Matrix3d::Identity(), {}, {}).pan_rad, 0.0);
  EXPECT_LT(servo.acceleration(Eigen::Matrix3d::Identity(), wanted, {1.0, 0.0}).pan_rad, 0.0);
}

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
