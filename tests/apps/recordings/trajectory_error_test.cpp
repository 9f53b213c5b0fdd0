// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/recordings/trajectory_error.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

std::vector<TimedPose> helix(int count) {
  std::vector<TimedPose> path;
  for (int i = 0; i < count; ++i) {
    TimedPose pose{at(0.1 * i), Pose::Identity()};
    pose.X_WB.translation() = Vec3{3.0 * std::cos(0.2 * i), 3.0 * std::sin(0.2 * i), 0.1 * i};
    path.push_back(pose);
  }
  return path;
}

TEST(TrajectoryError, is_zero_for_the_same_path_seen_from_elsewhere) {
  const auto truth = helix(40);
  auto estimate = truth;
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd{1.1, Vec3{1, 2, 3}.normalized()}.toRotationMatrix();
  X.translation() = Vec3{5, -6, 7};
  for (TimedPose& pose : estimate) {
    pose.X_WB = X * pose.X_WB;
  }
  const auto error = absolute_trajectory_error(estimate, truth);
  ASSERT_TRUE(error);
  EXPECT_LT(error->max_m, 1e-9);
  EXPECT_EQ(error->pairs, 40);
  EXPECT_NEAR(error->path_m, 39 * std::sqrt(std::pow(6.0 * std::sin(0.1), 2) + 0.01), 1e-9);
}

// A path twice as large is not the same path: the camera measures depth, so scale is its business.
TEST(TrajectoryError, counts_a_wrong_scale) {
  const auto truth = helix(40);
  auto estimate = truth;
  for (TimedPose& pose : estimate) {
    pose.X_WB.translation() *= 2.0;
  }
  EXPECT_GT(absolute_trajectory_error(estimate, truth)->rmse_m, 1.0);
}

// Every second pose .2 m to one side, the others .2 m to the other: no motion makes up for that.
TEST(TrajectoryError, is_what_no_rigid_motion_takes_away) {
  std::vector<TimedPose> truth;
  std::vector<TimedPose> estimate;
  for (int i = 0; i < 400; ++i) {
    TimedPose pose{at(0.1 * i), Pose::Identity()};
    pose.X_WB.translation() = Vec3{0.5 * (i / 2), i < 200 ? 0.0 : 30.0, 0.0};
    truth.push_back(pose);
    pose.X_WB.translation().z() += i % 2 == 0 ? 0.2 : -0.2;
    estimate.push_back(pose);
  }
  const auto error = absolute_trajectory_error(estimate, truth);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->rmse_m, 0.2, 0.002);
  EXPECT_NEAR(error->median_m, 0.2, 0.01);
}

TEST(TrajectoryError, compares_only_poses_of_the_same_time) {
  const auto truth = helix(40);
  auto estimate = helix(40);
  for (std::size_t i = 10; i < 40; ++i) {
    estimate[i].stamp += std::chrono::milliseconds{45};
  }
  const auto error = absolute_trajectory_error(estimate, truth);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->pairs, 10);
  EXPECT_FALSE(absolute_trajectory_error({estimate.begin(), estimate.begin() + 2}, truth));
  EXPECT_FALSE(absolute_trajectory_error(estimate, {}));
}

}  // namespace
}  // namespace flyball
