// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/odometry_frame.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double quarter_rad = 1.5707963267948966;

Pose pose_at(const Vec3& p, double yaw_rad = 0.0) {
  Pose pose = Pose::Identity();
  pose.translate(p);
  pose.rotate(Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()});
  return pose;
}

/// A vehicle that both see for a while, each in its own frame.
struct Watched {
  void watch(const Pose& X_OB, const Pose& X_WB, Duration by, bool is_standing = false) {
    for (const MissionTime end = now + by; now < end; now += 10ms) {
      frame.note(now, X_OB);
      frame.localized({now, X_WB}, is_standing);
    }
  }
  [[nodiscard]] Setpoint carried(const Vec3& p_WB) const {
    Setpoint setpoint;
    setpoint.p_WB = p_WB;
    setpoint.v_WB = {1.0, 0.0, 0.5};
    setpoint.a_WB = {0.0, 2.0, 0.0};
    return frame.in_odometry(setpoint);
  }

  OdometryFrame frame{};
  MissionTime now{};
};

TEST(OdometryFrame, is_the_localizers_world_where_nobody_says_otherwise) {
  const Watched seen;
  EXPECT_EQ(seen.carried({3.0, 4.0, 5.0}).p_WB, (Vec3{3.0, 4.0, 5.0}));
}

TEST(OdometryFrame, carries_set_points_over_by_what_both_see_of_the_standing_vehicle) {
  Watched seen;
  seen.watch(pose_at({10.0, 20.0, 1.0}, quarter_rad), pose_at({1.0, 2.0, 3.0}), 10ms, true);
  const Setpoint there = seen.carried({2.0, 2.0, 3.0});  // A metre ahead, which O calls north.
  EXPECT_TRUE(there.p_WB.isApprox(Vec3{10.0, 21.0, 1.0}, 1e-9)) << there.p_WB.transpose();
  EXPECT_TRUE(there.v_WB.isApprox(Vec3{0.0, 1.0, 0.5}, 1e-9)) << there.v_WB.transpose();
  EXPECT_TRUE(there.a_WB.isApprox(Vec3{-2.0, 0.0, 0.0}, 1e-9)) << there.a_WB.transpose();
  EXPECT_NEAR(there.yaw_rad, quarter_rad, 1e-9);
}

TEST(OdometryFrame, follows_a_jump_in_flight_at_half_a_metre_a_second) {
  Watched seen;
  seen.watch(pose_at(Vec3::Zero()), pose_at(Vec3::Zero()), 100ms, true);
  seen.watch(pose_at(Vec3::Zero()), pose_at({4.0, 0.0, 0.0}), 2s);
  EXPECT_NEAR(seen.carried({4.0, 0.0, 0.0}).p_WB.x(), 3.0, 0.02);
  seen.watch(pose_at(Vec3::Zero()), pose_at({4.0, 0.0, 0.0}), 15s);
  EXPECT_NEAR(seen.carried({4.0, 0.0, 0.0}).p_WB.x(), 0.0, 0.01);
}

TEST(OdometryFrame, turns_about_the_vehicle_and_not_faster_than_it_may) {
  Watched seen;
  const Vec3 far_m{300.0, -200.0, 10.0};
  seen.watch(pose_at(far_m), pose_at(far_m), 100ms, true);
  seen.watch(pose_at(far_m, 0.5), pose_at(far_m), 1s);
  const Setpoint there = seen.carried(far_m);
  EXPECT_TRUE(there.p_WB.isApprox(far_m, 1e-9)) << there.p_WB.transpose();
  EXPECT_NEAR(there.yaw_rad, 0.2, 1e-6);
}

// A localizer answers late. Who compared its answer with where the autopilot is by now would push
// the vehicle ahead, the more the faster it flies.
TEST(OdometryFrame, compares_poses_of_the_same_time) {
  OdometryFrame frame;
  const auto x_m = [](MissionTime at) { return 5.0 * to_seconds(at.time_since_epoch()); };
  for (MissionTime now{}; now < MissionTime{5s}; now += 10ms) {
    frame.note(now, pose_at({x_m(now), 0.0, 0.0}));
    const MissionTime captured = now - 300ms;
    frame.localized({captured, pose_at({x_m(captured), 0.0, 0.0})}, false);
  }
  EXPECT_NEAR(frame.in_odometry({}).p_WB.norm(), 0.0, 1e-9);
}

TEST(OdometryFrame, leaves_out_what_is_too_old_or_no_number) {
  Watched seen;
  seen.watch(pose_at(Vec3::Zero()), pose_at(Vec3::Zero()), 3s);
  seen.frame.localized({MissionTime{1s}, pose_at({9.0, 0.0, 0.0})}, true);
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  seen.frame.localized({seen.now, pose_at({no_number, 0.0, 0.0})}, true);
  seen.watch(pose_at({no_number, 0.0, 0.0}), pose_at(Vec3::Zero()), 1s);
  EXPECT_EQ(seen.carried(Vec3::Zero()).p_WB, Vec3::Zero());
}

}  // namespace
}  // namespace flyball
