// SPDX-License-Identifier: BSD-3-Clause
#include "autopilot/offboard_rig.h"
#include "vehicles/offboard_control.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(OffboardConnection, refuses_what_is_no_multirotor_of_the_two) {
  kit::StandInRules rules;
  rules.type = 1;
  kit::OffboardRig plane{rules};
  EXPECT_FALSE(plane.connect());
  EXPECT_NE(plane.control.failure().find("no multirotor"), std::string::npos);
}

TEST(OffboardConnection, says_that_nobody_was_heard) {
  kit::OffboardRig rig;
  rig.autopilot.be_silent(true);
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "no autopilot was heard within 15 s: nothing came; does the autopilot send to this "
            "address?");
}

TEST(OffboardConnection, says_that_what_came_was_no_autopilots) {
  kit::OffboardRig rig;
  rig.autopilot.be_silent(true);
  rig.each_turn = [&rig] {
    const std::uint8_t noise[] = {0xfd, 0x55, 0x00};
    rig.control.hear(noise, sizeof noise, rig.now);
  };
  EXPECT_FALSE(rig.connect());
  EXPECT_NE(rig.control.failure().find("holds no HEARTBEAT"), std::string::npos)
      << rig.control.failure();
}

TEST(OffboardConnection, connects_through_a_late_first_answer_and_a_line_that_loses_and_doubles) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    kit::StandInRules rules = kit::safe_rules(kind);
    rules.unanswered_first = 3;
    rules.lost_of = 7;
    rules.twice_of = 5;
    kit::OffboardRig rig{rules};
    ASSERT_TRUE(rig.connect()) << rig.control.failure();
    ASSERT_TRUE(rig.take_off(2.0)) << rig.control.failure();
    rig.fly({1.0, 0.0, 0.0}, 3s);
    EXPECT_NEAR(rig.autopilot.moved_m().x(), 3.0, 0.3);
    ASSERT_TRUE(rig.land()) << rig.control.failure();
  }
}

TEST(OffboardConnection, says_which_command_was_not_answered) {
  kit::StandInRules rules;
  rules.deaf_to = mav::command_message_interval;
  kit::OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "the autopilot was asked to send LOCAL_POSITION_NED and did not answer, 5 times");
}

TEST(OffboardConnection, flies_without_a_message_that_it_can_do_without_and_says_so) {
  kit::StandInRules rules;
  rules.denies_message = MavSystemStatus::kind.id;
  kit::OffboardRig rig{rules};
  EXPECT_TRUE(rig.connect());
  EXPECT_EQ(rig.news,
            "the autopilot was asked to send SYS_STATUS and answered DENIED; power is "
            "estimated\n");
  rules.denies_message = MavExtendedState::kind.id;
  kit::OffboardRig without_landed_state{rules};
  EXPECT_FALSE(without_landed_state.connect());
}

TEST(OffboardConnection, says_what_the_autopilot_does_not_tell) {
  kit::StandInRules rules;
  rules.never_sends = MavLocalPosition::kind.id;
  kit::OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "the autopilot does not yet say where it is; wait until it is ready to arm");
  EXPECT_EQ(rig.news,
            "the autopilot does not yet say where it is; it is waited for, 90 s at most\n");
}

TEST(OffboardConnection, does_not_take_over_a_vehicle_that_is_armed) {
  kit::OffboardRig rig;
  rig.autopilot.arm();
  EXPECT_FALSE(rig.connect());
  EXPECT_NE(rig.control.failure().find("land and disarm it"), std::string::npos);
}

TEST(OffboardConnection, warns_of_an_ardupilot_that_believes_old_set_points) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.guided_timeout_s = 3.0F;
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_NE(rig.news.find("GUID_TIMEOUT is 3.0 s"), std::string::npos) << rig.news;
}

TEST(OffboardConnection, does_not_fly_an_ardupilot_that_brakes_less_than_the_flight) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters["WPNAV_ACCEL"] = 250.0F;
  kit::OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "WPNAV_ACCEL is 250.0 cm/s^2: it brakes by no more, and the flight by up to "
            "mission.max_acceleration_m_s2; set it to 300.0");
}

TEST(OffboardConnection, warns_of_an_ardupilot_that_begins_to_brake_slowly) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters["PSC_JERK_XY"] = 5.0F;
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_EQ(rig.news,
            "PSC_JERK_XY is 5.0 m/s^3: it begins to brake so slowly that it flies past where it is "
            "to stop; set it to 20.0\n");
}

TEST(OffboardConnection, flies_an_ardupilot_that_has_no_such_parameter) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters.erase("WPNAV_ACCEL");
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_NE(rig.news.find("does not say its WPNAV_ACCEL"), std::string::npos) << rig.news;
}

}  // namespace
}  // namespace flyball
