// SPDX-License-Identifier: BSD-3-Clause
#include "autopilot/offboard_rig.h"
#include "vehicles/offboard_control.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(OffboardFlight, flies_a_line_and_lands_with_either_autopilot) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::OffboardRig rig{kit::safe_rules(kind)};
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

TEST(OffboardFlight, streams_to_px4_before_it_asks_for_the_mode_and_before_it_arms) {
  kit::OffboardRig rig;
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

TEST(OffboardFlight, goes_by_what_the_autopilot_shows_where_its_answers_are_lost) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::OffboardRig rig{kit::safe_rules(kind)};
    ASSERT_TRUE(rig.connect());
    rig.autopilot.rules().loses_answers = true;
    rig.control.obey({FlightCommand::Kind::take_off, 2.0}, rig.now);
    ASSERT_TRUE(rig.run(30s, [&] { return rig.autopilot.moved_m().z() > 0.3; }));
    rig.autopilot.rules().loses_answers = false;  // It denies what is asked once more in the air.
    ASSERT_TRUE(rig.run(30s, [&] { return rig.is_done(); }));
    EXPECT_EQ(rig.control.failure(), "");
    rig.autopilot.rules().loses_answers = true;
    rig.run(5s);  // Nothing is repeated any more.
    const std::size_t asked = rig.autopilot.commands().size();
    ASSERT_TRUE(rig.land()) << rig.control.failure();
    EXPECT_LE(rig.autopilot.commands().size() - asked, 3U);  // Until a heartbeat shows the mode.
  }
}

TEST(OffboardFlight, arms_and_takes_off_no_more_once_somebody_has_taken_over) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::StandInRules rules = kit::safe_rules(kind);
    rules.deaf_to = mav::command_arm;
    kit::OffboardRig rig{rules};
    ASSERT_TRUE(rig.connect());
    rig.control.obey({FlightCommand::Kind::take_off, 2.0}, rig.now);
    const auto last = [&rig] { return rig.autopilot.commands().back().command; };
    ASSERT_TRUE(rig.run(10s, [&] { return last() == mav::command_arm; }));
    rig.autopilot.switch_mode(kind == AutopilotKind::px4 ? kit::StandInAutopilot::px4_position
                                                         : kit::StandInAutopilot::copter_loiter);
    ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.failure().empty(); }));
    EXPECT_NE(rig.control.failure().find("somebody took over"), std::string::npos);
    rig.autopilot.rules().deaf_to = 0;
    const std::size_t asked = rig.autopilot.commands().size();
    rig.run(5s);
    EXPECT_EQ(rig.autopilot.commands().size(), asked);
    EXPECT_NEAR(rig.autopilot.moved_m().z(), 0.0, 0.1);
    EXPECT_FALSE(rig.control.is_in_charge());
  }
}

TEST(OffboardFlight, that_ends_before_it_is_armed_does_not_take_off) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    for (const bool gives_up : {false, true}) {
      kit::OffboardRig rig{kit::safe_rules(kind)};
      ASSERT_TRUE(rig.connect());
      rig.autopilot.rules().deaf_to = mav::command_set_mode;  // ArduPilot would arm at once.
      rig.control.obey({FlightCommand::Kind::take_off, 2.0}, rig.now);
      rig.run(500ms);
      if (gives_up) {
        rig.control.give_up("the flight is off", rig.now);
      } else {
        rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
      }
      rig.autopilot.rules().deaf_to = 0;
      rig.run(8s);
      EXPECT_FALSE(rig.autopilot.is_armed());
      EXPECT_TRUE(rig.control.status(rig.now).manoeuvre_done);
    }
  }
}

TEST(OffboardFlight, ends_before_the_flight_when_arming_is_denied) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::StandInRules rules = kit::safe_rules(kind);
    rules.denies_arming = true;
    kit::OffboardRig rig{rules};
    ASSERT_TRUE(rig.connect());
    EXPECT_FALSE(rig.take_off(2.0));
    EXPECT_EQ(rig.control.failure(), "the autopilot was asked to arm and answered DENIED");
    const std::size_t streamed = rig.autopilot.targets().size();
    rig.run(2s);
    EXPECT_EQ(rig.autopilot.targets().size(), streamed);
    EXPECT_FALSE(rig.control.is_in_charge());
  }
}

TEST(OffboardFlight, a_vehicle_that_is_armed_and_may_not_take_off_can_be_disarmed_by_landing) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.denies_take_off = true;
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_FALSE(rig.take_off(2.0));
  EXPECT_EQ(rig.control.failure(), "the autopilot was asked to take off and answered DENIED");
  EXPECT_TRUE(rig.autopilot.is_armed());
  EXPECT_TRUE(rig.control.is_in_charge());
  rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
  EXPECT_TRUE(rig.run(5s, [&] { return !rig.control.is_in_charge(); }));
  EXPECT_FALSE(rig.autopilot.is_armed());
}

TEST(OffboardFlight, holds_a_vehicle_whose_landing_is_denied) {
  kit::StandInRules rules;
  rules.denies_landing = true;
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  EXPECT_FALSE(rig.land());
  EXPECT_EQ(rig.control.failure(), "the autopilot was asked to land and answered DENIED");
  rig.run(5s);
  EXPECT_EQ(rig.autopilot.mode(), commanded_mode(AutopilotKind::px4));  // Still streamed.
  EXPECT_NEAR(rig.autopilot.moved_m().z(), 1.9, 0.31);
  EXPECT_TRUE(rig.control.is_in_charge());
}

TEST(OffboardFlight, has_not_landed_before_the_autopilot_says_that_it_stands) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.run(1s);
  rig.autopilot.rules().never_sends = MavExtendedState::kind.id;
  EXPECT_FALSE(rig.land());
  EXPECT_FALSE(rig.autopilot.is_armed());
  EXPECT_TRUE(rig.control.is_in_charge());
  rig.autopilot.rules().never_sends = kit::StandInRules{}.never_sends;
  EXPECT_TRUE(rig.run(2s, [&] { return rig.is_done(); }));
  EXPECT_EQ(rig.control.failure(), "");
}

TEST(OffboardFlight, asks_to_land_also_where_it_does_not_know_whether_it_was_armed) {
  kit::StandInRules rules;
  rules.deaf_to = mav::command_arm;
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  rig.control.obey({FlightCommand::Kind::take_off, 2.0}, rig.now);
  const auto last = [&rig] { return rig.autopilot.commands().back().command; };
  ASSERT_TRUE(rig.run(10s, [&] { return last() == mav::command_arm; }));
  rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
  rig.run(10ms);
  EXPECT_TRUE(rig.control.is_in_charge());  // Until somebody says yes.
  ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.is_in_charge(); }));
  EXPECT_EQ(last(), mav::command_land);
}

TEST(OffboardFlight, lets_go_at_once_when_somebody_takes_over) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::OffboardRig rig{kit::safe_rules(kind)};
    ASSERT_TRUE(rig.connect());
    ASSERT_TRUE(rig.take_off(2.0));
    const bool is_px4 = kind == AutopilotKind::px4;
    rig.autopilot.switch_mode(is_px4 ? kit::StandInAutopilot::px4_position
                                     : kit::StandInAutopilot::copter_loiter);
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

TEST(OffboardFlight, lets_go_when_somebody_takes_over_while_it_lands) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(10.0));
  rig.control.obey({FlightCommand::Kind::land, 0.0}, rig.now);
  rig.run(3s);
  rig.autopilot.switch_mode(kit::StandInAutopilot::px4_position);
  ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.failure().empty(); }));
  EXPECT_NE(rig.control.failure().find("somebody took over"), std::string::npos);
}

TEST(OffboardFlight, says_that_it_was_disarmed_in_flight) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.autopilot.disarm();
  ASSERT_TRUE(rig.run(2s, [&] { return !rig.control.failure().empty(); }));
  EXPECT_EQ(rig.control.failure(), "the autopilot was disarmed in flight");
}

TEST(OffboardFlight, is_told_by_px4s_fail_safe_that_the_line_was_dead_for_too_long) {
  kit::OffboardRig rig;
  ASSERT_TRUE(rig.connect());
  ASSERT_TRUE(rig.take_off(2.0));
  rig.autopilot.be_silent(true);  // Both ways.
  rig.run(4s);
  rig.autopilot.be_silent(false);
  ASSERT_TRUE(rig.run(3s, [&] { return !rig.control.failure().empty(); }));
  EXPECT_NE(rig.control.failure().find("went to hold"), std::string::npos);
}

}  // namespace
}  // namespace flyball
