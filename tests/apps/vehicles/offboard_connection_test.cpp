// SPDX-License-Identifier: BSD-3-Clause
#include "autopilot/offboard_rig.h"
#include "vehicles/offboard_control.h"
#include <string>

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
  EXPECT_NE(rig.news.find("GUID_TIMEOUT is 3 s"), std::string::npos) << rig.news;
}

TEST(OffboardConnection, does_not_fly_an_ardupilot_that_brakes_less_than_the_flight) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters["WPNAV_ACCEL"] = 250.0F;
  kit::OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "WPNAV_ACCEL is 250 cm/s^2: it brakes by no more, and the flight by up to "
            "mission.max_acceleration_m_s2; set it to 300");
}

TEST(OffboardConnection, warns_of_an_ardupilot_that_begins_to_brake_slowly) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters["PSC_JERK_XY"] = 5.0F;
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect());
  EXPECT_EQ(rig.news,
            "PSC_JERK_XY is 5 m/s^3: it begins to brake so slowly that it flies past where it is "
            "to stop; set it to 20\n");
}

/// Copter 4.7 has other names, and metres where centimetres were.
kit::StandInRules rules_of_4_7(float acceleration_m_s2, const char* jerk_name, float jerk_m_s3) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters = {{"WP_ACC", acceleration_m_s2}, {jerk_name, jerk_m_s3}};
  return rules;
}

TEST(OffboardConnection, flies_an_ardupilot_with_the_names_and_units_of_4_7) {
  for (const char* jerk_name : {"PSC_JERK_NE", "PSC_NE_JERK"}) {
    kit::OffboardRig rig{rules_of_4_7(3.0F, jerk_name, 20.0F)};
    ASSERT_TRUE(rig.connect()) << rig.control.failure();
    EXPECT_EQ(rig.news, "");
  }
}

TEST(OffboardConnection, does_not_fly_an_ardupilot_4_7_that_brakes_less_than_the_flight) {
  kit::OffboardRig rig{rules_of_4_7(2.5F, "PSC_JERK_NE", 20.0F)};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "WP_ACC is 2.5 m/s^2: it brakes by no more, and the flight by up to "
            "mission.max_acceleration_m_s2; set it to 3");
}

TEST(OffboardConnection, warns_of_an_ardupilot_4_7_that_begins_to_brake_slowly) {
  for (const std::string jerk_name : {"PSC_JERK_NE", "PSC_NE_JERK"}) {
    kit::OffboardRig rig{rules_of_4_7(3.0F, jerk_name.c_str(), 5.0F)};
    ASSERT_TRUE(rig.connect()) << rig.control.failure();
    EXPECT_EQ(rig.news, jerk_name +
                            " is 5 m/s^3: it begins to brake so slowly that it flies past where "
                            "it is to stop; set it to 20\n");
  }
}

TEST(OffboardConnection, flies_an_ardupilot_whose_limit_was_set_as_the_sentence_says) {
  for (const double acceleration_m_s2 : {2.7182818, 3.1}) {  // No `float` is any of them.
    kit::OffboardRig refused{rules_of_4_7(2.5F, "PSC_NE_JERK", 20.0F), acceleration_m_s2};
    ASSERT_FALSE(refused.connect());
    const std::string& why = refused.control.failure();
    const float said = std::stof(why.substr(why.rfind(' ')));
    kit::OffboardRig flown{rules_of_4_7(said, "PSC_NE_JERK", 20.0F), acceleration_m_s2};
    EXPECT_TRUE(flown.connect()) << flown.control.failure();
  }
}

TEST(OffboardConnection, does_not_fly_an_ardupilot_that_does_not_say_how_it_brakes) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters.erase("WPNAV_ACCEL");
  kit::OffboardRig rig{rules};
  EXPECT_FALSE(rig.connect());
  EXPECT_EQ(rig.control.failure(),
            "the autopilot says none of WPNAV_ACCEL, WP_ACC, and is not flown: it brakes by no "
            "more, and the flight by up to mission.max_acceleration_m_s2; fly Copter 4.1 to 4.7, "
            "over a line that carries parameters");
}

TEST(OffboardConnection, flies_an_ardupilot_without_a_parameter_that_it_can_do_without) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::ardupilot);
  rules.parameters.erase("PSC_JERK_XY");
  kit::OffboardRig rig{rules};
  ASSERT_TRUE(rig.connect()) << rig.control.failure();
  EXPECT_EQ(rig.news,
            "the autopilot says none of PSC_JERK_XY, PSC_JERK_NE, PSC_NE_JERK; set beyond its "
            "limit, it begins to brake so slowly that it flies past where it is to stop\n");
}

}  // namespace
}  // namespace flyball
