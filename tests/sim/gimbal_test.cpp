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

Pose turned_by(const GimbalJoints& joints) {
  Pose X_BG = Pose::Identity();
  X_BG.linear() = (Eigen::AngleAxisd{joints.pan, Vec3::UnitZ()} *
                   Eigen::AngleAxisd{joints.roll, Vec3::UnitX()} *
                   Eigen::AngleAxisd{joints.tilt, Vec3::UnitY()})
                      .toRotationMatrix();
  return X_BG;
}

TEST(GimbalServo, wants_joints_that_hold_the_camera_where_it_was_told_whatever_the_body_does) {
  GimbalServo servo{{}};
  const GimbalAngles told{0.4, 0.6};
  servo.aim(told);
  servo.slew(1.0);
  const GimbalJoints upright = servo.wanted_joints(Eigen::Matrix3d::Identity());
  EXPECT_NEAR(upright.pan, told.pan_rad, 1e-12);
  EXPECT_NEAR(upright.roll, 0.0, 1e-12);
  EXPECT_NEAR(upright.tilt, told.tilt_rad, 1e-12);
  Pose X_WB = Pose::Identity();
  X_WB.linear() = leaning(2.0, 0.3, -0.2);
  const Pose X_WC =
      X_WB * turned_by(servo.wanted_joints(X_WB.linear())) * camera_in_level_frame({});
  const Pose told_W = level_frame(X_WB) * camera_in_level_frame(told);
  EXPECT_TRUE(X_WC.linear().isApprox(told_W.linear(), 1e-12));
}

TEST(GimbalServo, goes_to_its_stops_and_ignores_a_command_that_is_none) {
  const GimbalSpec spec;
  GimbalServo servo{spec};
  servo.aim({-9.0, 0.2});
  servo.slew(10.0);
  const auto wanted = [&] { return servo.wanted_joints(Eigen::Matrix3d::Identity()); };
  EXPECT_DOUBLE_EQ(wanted().pan, -spec.max_pan_rad);
  servo.aim({std::numeric_limits<double>::quiet_NaN(), 0.0});
  EXPECT_NEAR(wanted().tilt, 0.2, 1e-12);
  servo.aim({0.0, 0.2});  // A body that leans over: the joints have their stops, too.
  servo.slew(10.0);
  EXPECT_DOUBLE_EQ(servo.wanted_joints(leaning(0.0, 1.2, 0.0)).tilt, spec.min_tilt_rad);
  EXPECT_DOUBLE_EQ(servo.wanted_joints(leaning(0.0, 0.0, 1.2)).roll, -spec.max_roll_rad);
}

TEST(GimbalServo, looks_elsewhere_no_faster_than_its_rate) {
  const GimbalSpec spec;
  GimbalServo servo{spec};
  servo.aim({0.9, -0.1});
  servo.slew(0.1);
  const GimbalJoints wanted = servo.wanted_joints(Eigen::Matrix3d::Identity());
  EXPECT_NEAR(wanted.pan, 0.1 * spec.max_rate_rad_s, 1e-12);
  EXPECT_NEAR(wanted.tilt, -0.1, 1e-12);
  EXPECT_GT(servo.acceleration(Eigen::Matrix3d::Identity(), {}, {}).pan, 0.0);
  EXPECT_LT(servo.acceleration(Eigen::Matrix3d::Identity(), wanted, {1.0, 0.0, 0.0}).pan, 0.0);
}

}  // namespace
}  // namespace flyball
