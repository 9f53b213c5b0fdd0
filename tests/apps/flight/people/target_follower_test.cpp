// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/target_follower.h"

#include "flyball/flight/people/tracked_time.h"
#include "flyball/sim/colour_camera.h"
#include "flyball/sim/person.h"

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

TEST(TrackedTime, takes_nothing_back_where_a_clock_begins_anew) {
  TrackedTime tracked;
  tracked.on_target(MissionTime{100s});
  tracked.on_target(MissionTime{100500ms});
  tracked.on_target(MissionTime{5s});
  EXPECT_EQ(tracked.seconds(), 0.5);
  tracked.on_target(MissionTime{5250ms});
  EXPECT_EQ(tracked.seconds(), 0.75);
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
      const Target target = seen(now, person_W, X_WL);
      if (i % 17 == 0) {  // A detector that takes .34 s.
        follower.detected(target, pose);
      }
      follower.tracked(target, pose);
      setpoint = follower.tick(now, 20ms, 10.0);
    }
    return setpoint;
  }
  /// Some seconds without a measurement.
  Setpoint unseen(double time_s) {
    Setpoint setpoint;
    for (int i = 0; i < static_cast<int>(std::lround(time_s / 0.02)); ++i) {
      now += 20ms;
      setpoint = follower.tick(now, 20ms, 10.0);
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

TEST_F(Follower, goes_on_for_a_while_when_it_sees_nobody_but_slower_and_slower) {
  fly(10.0, {7.0, 0.0, 0.0}, {1.2, 0.0, 0.0});
  const double start_x_m = unseen(0.02).p_WB.x();
  const Setpoint second = unseen(1.0);
  EXPECT_GT(second.p_WB.x() - start_x_m, 0.7);
  const Setpoint third = unseen(1.5);  // Behind a tree, perhaps.
  EXPECT_GT(third.p_WB.x(), second.p_WB.x() + 0.5);
  EXPECT_LT(third.v_WB.x(), 0.7);
  EXPECT_NEAR(third.yaw_rate_rad_s, 0.0, 0.05);
}

TEST_F(Follower, then_goes_near_where_the_person_should_be_and_turns_to_the_side_they_went) {
  for (const double side : {1.0, -1.0}) {
    follower = TargetFollower{FollowSettings{}};
    now = MissionTime{};
    fly(10.0, {7.0, 0.0, 0.0}, {0.2, side * 0.8, 0.0});
    const Vec3 last_seen_W = person_W;
    const Setpoint coasted = unseen(FollowSettings{}.coast_s);
    const Setpoint nearer = unseen(0.8);
    EXPECT_LT((nearer.p_WB - last_seen_W).norm(), (coasted.p_WB - last_seen_W).norm());
    EXPECT_NEAR(nearer.yaw_rate_rad_s, 0.0, 0.2) << "it looks there on its way";
    const Setpoint there = unseen(12.0);
    EXPECT_LT((there.p_WB - last_seen_W).head<2>().norm(), 7.0);
    EXPECT_LT(there.v_WB.norm(), 0.1);
    EXPECT_NEAR(there.yaw_rate_rad_s, side * FollowSettings{}.search_rate_rad_s, 1e-9);
  }
}

/// Somebody who stood before the vehicle has not been seen for 10 s.
class Searching : public Follower {
 protected:
  void SetUp() override {
    fly(10.0, {7.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    last = unseen(10.0);
    X_WL.linear() = Eigen::AngleAxisd{last.yaw_rad, Vec3::UnitZ()}.toRotationMatrix();
    X_WL.translation() = last.p_WB;
    pose.X_WB = X_WL;
    foot_W = X_WL * Vec3{13.0, 1.0, -4.5};
  }
  /// How far the camera looks past the place.
  [[nodiscard]] double off_rad(const Setpoint& setpoint) const {
    const double to_place_rad = yaw_of(foot_W - setpoint.p_WB);
    return std::abs(wrap_angle(to_place_rad - setpoint.yaw_rad - follower.gimbal().pan_rad));
  }
  Setpoint last;
  Pose X_WL{Pose::Identity()};
  PoseEstimate pose;
  Vec3 foot_W{Vec3::Zero()};
};

TEST_F(Searching, stops_to_look_again_at_a_person_where_they_can_hardly_be) {
  follower.detected(seen(now, foot_W, X_WL), pose);
  EXPECT_LT(off_rad(unseen(1.0)), 0.05);
  const Setpoint later = unseen(2.0);  // It was not repeated.
  EXPECT_NEAR(std::abs(later.yaw_rate_rad_s), FollowSettings{}.search_rate_rad_s, 1e-9);
}

TEST_F(Searching, follows_on_when_the_person_was_seen_there_twice) {
  follower.detected(seen(now, foot_W, X_WL), pose);
  now += 350ms;
  follower.detected(seen(now, foot_W + Vec3{0.3, 0.0, 0.0}, X_WL), pose);
  const Setpoint after = unseen(2.5);
  EXPECT_LT(off_rad(after), 0.05);
  EXPECT_GT((after.p_WB - last.p_WB).dot((foot_W - last.p_WB).normalized()), 1.0);
}

TEST_F(Searching, believes_no_tracker_that_holds_on_to_something_elsewhere) {
  for (int i = 0; i < 20; ++i) {
    now += 50ms;
    follower.tracked(seen(now, foot_W, X_WL), pose);
  }
  EXPECT_NEAR(std::abs(unseen(0.02).yaw_rate_rad_s), FollowSettings{}.search_rate_rad_s, 1e-9);
}

TEST_F(Follower, is_not_drawn_away_by_one_false_sighting) {
  const Setpoint before = fly(10.0, {7.0, 0.0, 0.0}, Vec3::Zero());
  now += 20ms;
  Pose X_WL = Pose::Identity();
  X_WL.translation() = before.p_WB;
  PoseEstimate pose;
  pose.X_WB = X_WL;
  follower.detected(seen(now, {15.0, 3.0, 0.0}, X_WL), pose);
  const Setpoint after = unseen(1.0);
  EXPECT_LT((after.p_WB - before.p_WB).norm(), 0.3);
}

TEST_F(Follower, stands_when_nobody_was_ever_seen_or_it_may_not_search) {
  follower.start(hover());
  EXPECT_EQ(unseen(5.0).yaw_rate_rad_s, 0.0);
  FollowSettings settings;
  settings.search_rate_rad_s = 0.0;
  follower = TargetFollower{settings};
  now = MissionTime{};
  fly(10.0, {7.0, 0.0, 0.0}, {1.2, 0.0, 0.0});
  const Setpoint last = unseen(6.0);
  EXPECT_LT(last.v_WB.norm(), 1e-9);
  EXPECT_EQ(last.yaw_rate_rad_s, 0.0);
}

TEST_F(Follower, tells_the_distance_from_the_ground_not_from_the_size_of_the_box) {
  // Boxes of people jitter by a tenth of their size and more; their middles do not.
  Target target = seen(now, {9.0, 0.0, 0.0}, hover().X_WB);
  target.box->y_px += 0.15 * target.box->height_px;
  target.box->height_px *= 0.7;
  follower.start(hover());
  follower.detected(target, hover());
  (void)unseen(0.02);
  // It aims at the middle of the person that it believes in.
  EXPECT_NEAR(follower.gimbal().tilt_rad, std::atan2(4.5 - 0.875, 9.0), 0.02);
}

TEST_F(Follower, does_not_go_back_to_what_it_was_told_late) {
  fly(10.0, {7.0, 0.0, 0.0}, Vec3::Zero());
  const Setpoint before = unseen(0.02);
  Pose X_WL = Pose::Identity();
  X_WL.translation() = before.p_WB;
  PoseEstimate pose;
  pose.X_WB = X_WL;
  follower.tracked(seen(MissionTime{9s}, {7.0, 5.0, 0.0}, X_WL), pose);
  EXPECT_NEAR(unseen(0.02).yaw_rate_rad_s, before.yaw_rate_rad_s, 0.05);
}

TEST_F(Follower, never_wants_more_than_its_acceleration) {
  follower.start(hover());
  Vec3 before = Vec3::Zero();
  for (int i = 0; i < 100; ++i) {
    now += 20ms;
    follower.detected(seen(now, {40.0, i < 50 ? 9.0 : -9.0, 0.0}, hover().X_WB), hover());
    const Setpoint next = follower.tick(now, 20ms, 10.0);
    EXPECT_LE((next.v_WB - before).norm(), 0.02 * FollowSettings{}.max_acceleration_m_s2 + 1e-9);
    before = next.v_WB;
  }
}

TEST_F(Follower, stands_where_it_is_told_to_and_faces_the_person_on) {
  follower.start(hover());
  const auto fly_for = [&](int ticks, double limit_m_s) {
    Setpoint setpoint;
    for (int i = 0; i < ticks; ++i) {
      now += 20ms;
      follower.detected(seen(now, {20.0, 0.0, 0.0}, hover().X_WB), hover());
      setpoint = follower.tick(now, 20ms, limit_m_s);
    }
    return setpoint;
  };
  EXPECT_GT(fly_for(60, 10.0).v_WB.norm(), 2.0);
  EXPECT_LE(fly_for(60, 1.0).v_WB.norm(), 1.0 + 1e-6);
  EXPECT_LT(fly_for(150, 0.0).v_WB.norm(), 1e-6);
  EXPECT_LT(std::abs(follower.gimbal().pan_rad), 0.1);
}

}  // namespace
}  // namespace flyball
