// SPDX-License-Identifier: BSD-3-Clause
#include "target_follower.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(Pid, pushes_by_error_by_its_sum_and_by_its_change) {
  Pid pid{{2.0, 1.0, 0.5, 100.0}};
  EXPECT_DOUBLE_EQ(pid.update(1.0, 0.1), 2.0);  // integral comes after
  EXPECT_DOUBLE_EQ(pid.update(2.0, 0.1), 4.0 + 0.1 + 0.5 * 10.0);
}

TEST(Pid, does_not_wind_up_at_its_limit) {
  Pid pid{{1.0, 1.0, 0.0, 2.0}};
  for (int i = 0; i < 1000; ++i) {
    EXPECT_DOUBLE_EQ(pid.update(10.0, 0.1), 2.0);
  }
  EXPECT_LT(pid.update(-1.0, 0.1), 0.0);
}

/// A person seen from a vehicle at 4.5 m that hovers at the origin, by the follower's own camera.
class Follower : public testing::Test {
 protected:
  static PoseEstimate hover(const Vec3& p_W = {0.0, 0.0, 4.5}) {
    PoseEstimate pose;
    pose.X_WB.translation() = p_W;
    return pose;
  }
  [[nodiscard]] Target seen(MissionTime at, const Vec3& foot_W, const Pose& X_WL) const {
    Target target;
    target.frame.captured = at;
    target.frame.camera = {384, 288, 301.4, 191.5, 143.5};
    target.frame.X_LC = camera_in_level_frame(follower.gimbal());
    Person person;
    person.walk = {{0.0, foot_W}};
    target.box = box_of(person, at, X_WL * target.frame.X_LC, target.frame.camera);
    return target;
  }
  /// Perfect flight and gimbal for some seconds; returns where the vehicle is then.
  Setpoint fly(double time_s, const Vec3& from_W, const Vec3& v_W) {
    Setpoint setpoint;
    setpoint.p_WB = {0.0, 0.0, 4.5};
    follower.start(hover());
    for (int i = 0; i < static_cast<int>(time_s / 0.02); ++i) {
      now += 20ms;
      Pose X_WL = Pose::Identity();
      X_WL.linear() = Eigen::AngleAxisd{setpoint.yaw_rad, Vec3::UnitZ()}.toRotationMatrix();
      X_WL.translation() = setpoint.p_WB;
      person_W = from_W + to_seconds(now) * v_W;
      PoseEstimate pose;
      pose.X_WB = X_WL;
      follower.see(seen(now, person_W, X_WL), pose);
      setpoint = follower.tick(now, 20ms);
    }
    return setpoint;
  }
  TargetFollower follower{FollowSettings{}};
  MissionTime now{};
  Vec3 person_W{Vec3::Zero()};
};

TEST_F(Follower, goes_to_its_distance_from_somebody_who_stands_and_stays_there) {
  const Setpoint last = fly(20.0, {12.0, 0.0, 0.0}, Vec3::Zero());
  // The box is that of the cylinder: its rims make the person seem taller, so nearer.
  EXPECT_NEAR((person_W - last.p_WB).head<2>().norm(), FollowSettings{}.distance_m, 1.3);
  EXPECT_LT(last.v_WB.norm(), 0.1);
  EXPECT_NEAR(last.p_WB.z(), 4.5, 1e-9);
}

TEST_F(Follower, keeps_up_with_a_walker_and_looks_there) {
  const Setpoint last = fly(30.0, {7.0, 0.0, 0.0}, {0.8, 1.0, 0.0});
  const Vec3 to_person = person_W - last.p_WB;
  EXPECT_NEAR(to_person.head<2>().norm(), FollowSettings{}.distance_m, 1.5);
  EXPECT_NEAR(wrap_angle(yaw_of(to_person) - last.yaw_rad - follower.gimbal().pan_rad), 0.0, 0.05);
  EXPECT_NEAR(last.v_WB.norm(), 1.28, 0.3);
}

TEST_F(Follower, backs_off_from_somebody_who_comes_near) {
  const Setpoint last = fly(10.0, {3.5, 0.0, 0.0}, Vec3::Zero());
  EXPECT_LT(last.p_WB.x(), -1.0);
}

TEST_F(Follower, goes_on_for_a_while_when_it_sees_nobody_and_then_stops) {
  fly(10.0, {7.0, 0.0, 0.0}, {1.2, 0.0, 0.0});
  Setpoint last;
  for (int i = 0; i < 100; ++i) {  // 2 s: behind a tree, perhaps.
    now += 20ms;
    last = follower.tick(now, 20ms);
  }
  EXPECT_NEAR(last.v_WB.x(), 1.2, 0.3);
  for (int i = 0; i < 150; ++i) {
    now += 20ms;
    last = follower.tick(now, 20ms);
  }
  EXPECT_LT(last.v_WB.norm(), 1e-9);
  EXPECT_EQ(last.yaw_rate_rad_s, 0.0);
}

TEST_F(Follower, never_wants_more_than_its_acceleration) {
  follower.start(hover());
  Vec3 before = Vec3::Zero();
  for (int i = 0; i < 100; ++i) {
    now += 20ms;
    follower.see(seen(now, {40.0, i < 50 ? 9.0 : -9.0, 0.0}, hover().X_WB), hover());
    const Setpoint next = follower.tick(now, 20ms);
    EXPECT_LE((next.v_WB - before).norm(), 0.02 * FollowSettings{}.max_acceleration_m_s2 + 1e-9);
    before = next.v_WB;
  }
}

}  // namespace
}  // namespace flyball
