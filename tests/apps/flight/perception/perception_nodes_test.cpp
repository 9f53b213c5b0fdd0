// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/perception_nodes.h"

#include "flyball/flight/perception/pose_history.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

PoseEstimate pose_at(Duration t, double x_m) {
  PoseEstimate pose;
  pose.stamp = MissionTime{t};
  pose.X_WB.translation() = Vec3{x_m, 0.0, 1.0};
  return pose;
}

TEST(PoseHistory, interpolates_between_two_poses) {
  PoseHistory history;
  history.add(pose_at(100ms, 1.0));
  history.add(pose_at(200ms, 3.0));
  EXPECT_NEAR(history.at(MissionTime{150ms})->X_WB.translation().x(), 2.0, 1e-12);
  EXPECT_NEAR(history.at(MissionTime{100ms})->X_WB.translation().x(), 1.0, 1e-12);
}

TEST(PoseHistory, answers_with_the_nearest_end_outside_of_what_it_keeps) {
  PoseHistory history;
  EXPECT_FALSE(history.at(MissionTime{1s}).has_value());
  history.add(pose_at(1s, 1.0));
  history.add(pose_at(10s, 2.0));  // Forgets the first.
  EXPECT_NEAR(history.at(MissionTime{1s})->X_WB.translation().x(), 2.0, 1e-12);
  EXPECT_NEAR(history.at(MissionTime{99s})->X_WB.translation().x(), 2.0, 1e-12);
}

TEST(CameraPose, looks_along_the_heading_and_stays_level) {
  Pose X_WB = Pose::Identity();
  X_WB.translation() = Vec3{1.0, 2.0, 3.0};
  X_WB.linear() = (Eigen::AngleAxisd{1.0, Vec3::UnitZ()} * Eigen::AngleAxisd{0.4, Vec3::UnitY()} *
                   Eigen::AngleAxisd{-0.3, Vec3::UnitX()})
                      .toRotationMatrix();
  const Pose X_WC = camera_pose(X_WB, {});
  const Vec3 ahead = X_WC.linear() * Vec3::UnitZ();
  EXPECT_NEAR(ahead.z(), 0.0, 1e-12);
  EXPECT_NEAR(yaw_of(ahead), yaw_of(X_WB.linear().col(0)), 1e-12);
  EXPECT_NEAR((X_WC.linear() * Vec3::UnitY()).z(), -1.0, 1e-12);  // y of the image points down.
  EXPECT_EQ(X_WC.translation(), X_WB.translation());
}

TEST(CameraPose, is_mounted_where_the_scenario_says) {
  Pose X_WB = Pose::Identity();
  X_WB.linear() = Eigen::AngleAxisd{1.5707963267948966, Vec3::UnitZ()}.toRotationMatrix();
  DepthCameraSpec mount;
  mount.forward_m = 0.2;
  mount.up_m = -0.1;
  mount.pitch_down_rad = 0.5;
  const Pose X_WC = camera_pose(X_WB, mount);
  EXPECT_TRUE(X_WC.translation().isApprox(Vec3{0.0, 0.2, -0.1}));
  const Vec3 ahead = X_WC.linear() * Vec3::UnitZ();
  EXPECT_NEAR(ahead.z(), -std::sin(0.5), 1e-12);
  EXPECT_NEAR(ahead.y(), std::cos(0.5), 1e-12);
}

}  // namespace
}  // namespace flyball
