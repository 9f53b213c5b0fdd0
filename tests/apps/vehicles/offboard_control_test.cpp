// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/offboard_control.h"

#include "autopilot/offboard_rig.h"
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(OffboardControl, sees_the_vehicle_where_it_is_in_the_missions_world) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  const VehicleMotion standing = rig.control.motion(rig.now);
  EXPECT_TRUE(standing.X_WB.translation().isApprox(rig.start_W, 1e-5));  // Floats of 100 m.
  EXPECT_NEAR(yaw_of(standing.X_WB.linear().col(0)), rig.autopilot.rules().yaw_rad, 1e-5);
  ASSERT_TRUE(rig.take_off(2.0));
  rig.fly({2.0, -1.0, 0.0}, 3s);
  const VehicleMotion moving = rig.control.motion(rig.now);
  const auto& truth = rig.autopilot.truth();
  // A message is at most a period of 20 ms old, and is moved on meanwhile.
  EXPECT_LT((moving.X_WB.translation() - rig.start_W - rig.autopilot.moved_m()).norm(), 0.02);
  EXPECT_LT((moving.v_WB - truth.v_WB).norm(), 0.1);
  EXPECT_LT((moving.X_WB.linear() - truth.X_WB.linear()).norm(), 0.02);
}

TEST(OffboardControl, turns_the_vehicle_to_the_heading_that_is_asked_for) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::OffboardRig rig{kit::safe_rules(kind)};
    ASSERT_TRUE(rig.connect());
    ASSERT_TRUE(rig.take_off(2.0));
    rig.fly(Vec3::Zero(), 3s, 2.0);
    const auto& truth = rig.autopilot.truth();
    EXPECT_NEAR(yaw_of(truth.X_WB.linear().col(0)), 2.0, 0.02);
    rig.run(2s);  // Without set-points it keeps it.
    EXPECT_NEAR(yaw_of(truth.X_WB.linear().col(0)), 2.0, 0.02);
  }
}

TEST(OffboardControl, beats_once_a_second) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  const int before = rig.autopilot.heartbeats();
  rig.run(10s);
  EXPECT_EQ(rig.autopilot.heartbeats() - before, 10);
}

TEST(OffboardControl, stops_and_holds_when_the_flight_falls_silent) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(3.0));
  rig.fly({2.0, 0.0, 0.0}, 3s);
  const double before_m = rig.autopilot.moved_m().x();
  rig.run(5s);
  EXPECT_EQ(rig.autopilot.mode(), commanded_mode(AutopilotKind::px4));
  EXPECT_LT(rig.autopilot.truth().v_WB.norm(), 0.05);
  // Half a second at 2 m/s, then 2^2 / (2 * 5) m; the controller lags by less than .3 s.
  EXPECT_NEAR(rig.autopilot.moved_m().x() - before_m, 1.4, 0.6);
  EXPECT_EQ(rig.control.failure(), "");
}

TEST(OffboardControl, stops_where_the_set_points_led_when_nobody_says_where_the_vehicle_is) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(3.0));
  rig.fly({2.0, 0.0, 0.0}, 3s);
  rig.autopilot.lose_output(true);
  rig.fly({2.0, 0.0, 0.0}, 1s);
  const std::size_t flown = rig.autopilot.targets().size();
  rig.run(3s);  // Half a second with, and then without a set-point to follow.
  float before_m = 0.0F;
  for (std::size_t i = flown; i < rig.autopilot.targets().size(); ++i) {
    const float east_m = rig.autopilot.targets()[i].p_m[1];
    EXPECT_TRUE(i == flown || east_m >= before_m) << i;  // Never back.
    before_m = east_m;
  }
  EXPECT_LT(rig.autopilot.truth().v_WB.norm(), 0.05);
}

TEST(OffboardControl, never_sends_a_set_point_that_is_not_finite) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    Setpoint setpoint;
    setpoint.stamp = MissionTime{rig.now};
    setpoint.p_WB = rig.control.motion(rig.now).X_WB.translation();
    setpoint.v_WB.y() = bad;
    rig.control.follow(setpoint);
    rig.run(200ms);
  }
  EXPECT_EQ(rig.autopilot.bad_targets(), 0);
  EXPECT_LT(rig.autopilot.truth().v_WB.norm(), 0.3);
  EXPECT_EQ(rig.news, "a set-point that is not finite was refused\n");
}

TEST(OffboardControl, never_sends_a_set_point_that_leaves_all_numbers_before_the_next_one) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  Setpoint setpoint;
  setpoint.stamp = MissionTime{rig.now};
  setpoint.p_WB.z() = -3.3e38;  // A float ends at 3.4e38. Downwards, so that nobody flies far.
  setpoint.v_WB.z() = -3.3e38;
  rig.control.follow(setpoint);
  rig.run(400ms);
  EXPECT_EQ(rig.autopilot.bad_targets(), 0);
}

TEST(OffboardControl, says_that_the_link_is_silent_and_goes_on_when_it_is_back) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.autopilot.lose_output(true);  // It still hears us.
  rig.run(4s);
  EXPECT_FALSE(rig.control.is_fresh(rig.now));
  EXPECT_NE(rig.news.find("has not said for .25 s where it is"), std::string::npos) << rig.news;
  EXPECT_NE(rig.news.find("has not been heard for 3 s"), std::string::npos) << rig.news;
  rig.autopilot.lose_output(false);
  rig.run(2s);
  EXPECT_TRUE(rig.control.is_fresh(rig.now));
  EXPECT_NE(rig.news.find("says again where it is"), std::string::npos) << rig.news;
  EXPECT_NE(rig.news.find("is heard again, after"), std::string::npos) << rig.news;
  EXPECT_EQ(rig.control.failure(), "");
  rig.fly({1.0, 0.0, 0.0}, 2s);
  EXPECT_NEAR(rig.autopilot.moved_m().x(), 2.0, 0.3);
}

TEST(OffboardControl, passes_on_warnings_and_worse) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  rig.autopilot.say(6, "all is well");
  rig.autopilot.say(4, "low battery");
  rig.autopilot.say(2, std::string(60, 'a') + " the end", 9);
  rig.run(100ms);
  EXPECT_EQ(rig.news, "autopilot: low battery\nautopilot: " + std::string(60, 'a') + " the end\n");
}

TEST(OffboardControl, an_emergency_hold_ends_with_the_next_set_point) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.fly({2.0, 0.0, 0.0}, 2s);
  rig.control.obey({FlightCommand::Kind::hold, 0.0}, rig.now);
  rig.run(400ms);
  EXPECT_LT(rig.autopilot.truth().v_WB.x(), 1.0);
  rig.fly({2.0, 0.0, 0.0}, 1s);
  EXPECT_GT(rig.autopilot.truth().v_WB.x(), 1.5);
}

}  // namespace
}  // namespace flyball
