// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/offboard_control.h"

#include "autopilot/offboard_rig.h"
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using kit::OffboardRig;
using kit::StandInAutopilot;
using kit::StandInRules;

const auto both = {AutopilotKind::px4, AutopilotKind::ardupilot};

StandInRules rules_of(AutopilotKind kind) {
  StandInRules rules;
  rules.kind = kind;
  rules.guided_timeout_s = 0.5F;
  return rules;
}

TEST(OffboardControl, flies_a_line_and_lands_with_either_autopilot) {
  for (const AutopilotKind kind : both) {
    OffboardRig rig{rules_of(kind)};
    ASSERT_TRUE(rig.connect()) << rig.control.failure();
    EXPECT_TRUE(rig.control.may_touch_ground());
    EXPECT_FALSE(rig.control.status(rig.now).airborne);
    ASSERT_TRUE(rig.take_off(2.0)) << rig.control.failure();
    EXPECT_FALSE(rig.control.may_touch_ground());
    // Its centre is to be 2 m above the ground (-3 m), and it stood at -2.9 m.
    EXPECT_NEAR(rig.autopilot.moved_m().z(), 1.9, 0.31);
    rig.fly({1.0, 2.0, 0.0}, 5s);
    EXPECT_NEAR(rig.autopilot.moved_m().x(), 5.0, 0.3);
    EXPECT_NEAR(rig.autopilot.moved_m().y(), 10.0, 0.3);
    ASSERT_TRUE(rig.land()) << rig.control.failure();
    EXPECT_FALSE(rig.autopilot.is_armed());
    EXPECT_FALSE(rig.control.is_in_charge());
    EXPECT_EQ(rig.autopilot.bad_targets(), 0);
    ASSERT_TRUE(rig.take_off(1.5)) << rig.control.failure();  // Once more, from elsewhere.
    EXPECT_NEAR(rig.autopilot.moved_m().z(), 1.4, 0.31);
    EXPECT_EQ(rig.news, "") << rig.news;
  }
}

TEST(OffboardControl, sees_the_vehicle_where_it_is_in_the_missions_world) {
  OffboardRig rig;
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
  for (const AutopilotKind kind : both) {
    OffboardRig rig{rules_of(kind)};
    ASSERT_TRUE(rig.connect());
    ASSERT_TRUE(rig.take_off(2.0));
    rig.fly(Vec3::Zero(), 3s, 2.0);
    const auto& truth = rig.autopilot.truth();
    EXPECT_NEAR(yaw_of(truth.X_WB.linear().col(0)), 2.0, 0.02);
    rig.run(2s);  // Without set-points it keeps it.
    EXPECT_NEAR(yaw_of(truth.X_WB.linear().col(0)), 2.0, 0.02);
  }
}

TEST(OffboardControl, streams_to_px4_before_it_asks_for_the_mode_and_before_it_arms) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  EXPECT_TRUE(rig.autopilot.targets().empty());
  ASSERT_TRUE(rig.take_off(2.0)) << rig.control.failure();
  int refused = 0;
  for (const MavCommandLong& command : rig.autopilot.commands()) {
    refused += command.command == mav::command_set_mode ? 1 : 0;
  }
  EXPECT_EQ(refused, 1);  // The first was granted: there was a stream.
  EXPECT_LT(rig.autopilot.longest_target_gap_s(), 0.05);  // 20 Hz at least.
}

TEST(OffboardControl, beats_once_a_second) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  const int before = rig.autopilot.heartbeats();
  rig.run(10s);
  EXPECT_EQ(rig.autopilot.heartbeats() - before, 10);
}

TEST(OffboardControl, refuses_what_is_no_multirotor_of_the_two) {
  StandInRules rules;
  rules.type = 1;
  OffboardRig plane{rules};
  EXPECT_FALSE(plane.connect());
  EXPECT_NE(plane.control.failure().find("no multirotor"), std::string::npos);
}

TEST(OffboardControl, says_that_nobody_was_heard) {
  OffboardRig rig;
  rig.autopilot.be_silent(true);
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(), "no autopilot was heard within 15 s");
}

TEST(OffboardControl, connects_through_a_late_first_answer_and_a_line_that_loses_and_doubles) {
  for (const AutopilotKind kind : both) {
    StandInRules rules = rules_of(kind);
    rules.unanswered_first = 3;
    rules.lost_of = 7;
    rules.twice_of = 5;
    OffboardRig rig{rules};
    ASSERT_TRUE(rig.connect()) << rig.control.failure();
    ASSERT_TRUE(rig.take_off(2.0)) << rig.control.failure();
    rig.fly({1.0, 0.0, 0.0}, 3s);
    EXPECT_NEAR(rig.autopilot.moved_m().x(), 3.0, 0.3);
    ASSERT_TRUE(rig.land()) << rig.control.failure();
  }
}

TEST(OffboardControl, says_which_command_was_not_answered) {
  StandInRules rules;
  rules.deaf_to = mav::command_message_interval;
  OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "the autopilot was asked to send LOCAL_POSITION_NED and did not answer, 5 times");
}

TEST(OffboardControl, says_what_the_autopilot_does_not_tell) {
  StandInRules rules;
  rules.never_sends = MavLocalPosition::kind.id;
  OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "the autopilot does not say, where it is; wait until it is ready to arm");
}

TEST(OffboardControl, does_not_take_over_a_vehicle_that_is_armed) {
  OffboardRig rig;
  rig.autopilot.arm();
  EXPECT_FALSE(rig.connect());
  EXPECT_NE(rig.control.failure().find("land and disarm it"), std::string::npos);
}

TEST(OffboardControl, warns_of_an_ardupilot_that_believes_old_set_points) {
  StandInRules rules = rules_of(AutopilotKind::ardupilot);
  rules.guided_timeout_s = 3.0F;
  OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_NE(rig.news.find("GUID_TIMEOUT is 3.0 s"), std::string::npos) << rig.news;
}

TEST(OffboardControl, ends_before_the_flight_when_arming_is_denied) {
  for (const AutopilotKind kind : both) {
    StandInRules rules = rules_of(kind);
    rules.denies_arming = true;
    OffboardRig rig{rules};
    ASSERT_TRUE(rig.connect());
    EXPECT_FALSE(rig.take_off(2.0));
    EXPECT_EQ(rig.control.failure(), "the autopilot was asked to arm and answered DENIED");
    const std::size_t streamed = rig.autopilot.targets().size();
    rig.run(2s);
    EXPECT_EQ(rig.autopilot.targets().size(), streamed);
    EXPECT_FALSE(rig.control.is_in_charge());
  }
}

TEST(OffboardControl, a_vehicle_that_is_armed_and_may_not_take_off_can_be_disarmed_by_landing) {
  StandInRules rules = rules_of(AutopilotKind::ardupilot);
  rules.denies_take_off = true;
  OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_FALSE(rig.take_off(2.0));
  EXPECT_EQ(rig.control.failure(), "the autopilot was asked to take off and answered DENIED");
  EXPECT_TRUE(rig.autopilot.is_armed());
  EXPECT_TRUE(rig.control.is_in_charge());
  rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
  EXPECT_TRUE(rig.run(5s, [&] { return !rig.control.is_in_charge(); }));
  EXPECT_FALSE(rig.autopilot.is_armed());
}

TEST(OffboardControl, holds_a_vehicle_whose_landing_is_denied) {
  StandInRules rules;
  rules.denies_landing = true;
  OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  EXPECT_FALSE(rig.land());
  EXPECT_EQ(rig.control.failure(), "the autopilot was asked to land and answered DENIED");
  rig.run(5s);
  EXPECT_EQ(rig.autopilot.mode(), commanded_mode(AutopilotKind::px4));  // Still streamed.
  EXPECT_NEAR(rig.autopilot.moved_m().z(), 1.9, 0.31);
  EXPECT_TRUE(rig.control.is_in_charge());
}

TEST(OffboardControl, has_not_landed_before_the_autopilot_says_that_it_stands) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.run(1s);
  rig.autopilot.rules().never_sends = MavExtendedState::kind.id;
  EXPECT_FALSE(rig.land());
  EXPECT_FALSE(rig.autopilot.is_armed());
  EXPECT_TRUE(rig.control.is_in_charge());
  rig.autopilot.rules().never_sends = StandInRules{}.never_sends;
  EXPECT_TRUE(rig.run(2s, [&] { return rig.is_done(); }));
  EXPECT_EQ(rig.control.failure(), "");
}

TEST(OffboardControl, asks_to_land_also_where_it_does_not_know_whether_it_was_armed) {
  StandInRules rules;
  rules.deaf_to = mav::command_arm;
  OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  rig.control.obey({FlightCommand::Kind::take_off, 2.0}, rig.now);
  const auto last = [&rig] { return rig.autopilot.commands().back().command; };
  ASSERT_TRUE(rig.run(10s, [&] { return last() == mav::command_arm; }));
  rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
  ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.is_in_charge(); }));
  EXPECT_EQ(last(), mav::command_land);
}

TEST(OffboardControl, lets_go_at_once_when_somebody_takes_over) {
  for (const AutopilotKind kind : both) {
    OffboardRig rig{rules_of(kind)};
    ASSERT_TRUE(rig.connect());
    ASSERT_TRUE(rig.take_off(2.0));
    const bool is_px4 = kind == AutopilotKind::px4;
    rig.autopilot.switch_mode(is_px4 ? StandInAutopilot::px4_position
                                     : StandInAutopilot::copter_loiter);
    ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.failure().empty(); }));
    EXPECT_NE(rig.control.failure().find(is_px4 ? "went to position" : "went to LOITER"),
              std::string::npos)
        << rig.control.failure();
    const std::size_t asked = rig.autopilot.commands().size();
    const std::size_t streamed = rig.autopilot.targets().size();
    rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
    rig.control.obey({FlightCommand::Kind::take_off, 2.0}, rig.now);
    rig.fly({1.0, 0.0, 0.0}, 3s);
    EXPECT_EQ(rig.autopilot.commands().size(), asked);
    EXPECT_EQ(rig.autopilot.targets().size(), streamed);
    EXPECT_FALSE(rig.control.is_in_charge());
    EXPECT_FALSE(rig.control.status(rig.now).manoeuvre_done);
  }
}

TEST(OffboardControl, lets_go_when_somebody_takes_over_while_it_lands) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(10.0));
  rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
  rig.run(3s);
  rig.autopilot.switch_mode(StandInAutopilot::px4_position);
  ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.failure().empty(); }));
  EXPECT_NE(rig.control.failure().find("somebody took over"), std::string::npos);
}

TEST(OffboardControl, says_that_it_was_disarmed_in_flight) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.autopilot.disarm();
  ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.failure().empty(); }));
  EXPECT_EQ(rig.control.failure(), "the autopilot was disarmed in flight");
}

TEST(OffboardControl, stops_and_holds_when_the_flight_falls_silent) {
  OffboardRig rig;
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
  OffboardRig rig;
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
  OffboardRig rig;
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
  OffboardRig rig;
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
  OffboardRig rig;
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

TEST(OffboardControl, is_told_by_px4s_fail_safe_that_the_line_was_dead_for_too_long) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.autopilot.be_silent(true);  // Both ways.
  rig.run(4s);
  rig.autopilot.be_silent(false);
  ASSERT_TRUE(rig.run(3s, [&] { return !rig.control.failure().empty(); }));
  EXPECT_NE(rig.control.failure().find("went to hold"), std::string::npos);
}

TEST(OffboardControl, passes_on_warnings_and_worse) {
  OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  rig.autopilot.say(6, "all is well");
  rig.autopilot.say(4, "low battery");
  rig.autopilot.say(2, std::string(60, 'a') + " the end", 9);
  rig.run(100ms);
  EXPECT_EQ(rig.news, "autopilot: low battery\nautopilot: " + std::string(60, 'a') + " the end\n");
}

TEST(OffboardControl, an_emergency_hold_ends_with_the_next_set_point) {
  OffboardRig rig;
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
