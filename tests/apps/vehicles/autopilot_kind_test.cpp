// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/autopilot_kind.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

MavHeartbeat heartbeat_of(std::uint8_t maker, std::uint8_t type) {
  MavHeartbeat heartbeat;
  heartbeat.autopilot = maker;
  heartbeat.type = type;
  return heartbeat;
}

TEST(AutopilotKind, takes_multirotors_of_px4_and_ardupilot) {
  const auto px4 = autopilot_kind(heartbeat_of(12, 2));
  const auto copter = autopilot_kind(heartbeat_of(3, 13));
  ASSERT_TRUE(px4 && copter);
  EXPECT_EQ(*px4, AutopilotKind::px4);
  EXPECT_EQ(*copter, AutopilotKind::ardupilot);
}

TEST(AutopilotKind, refuses_others_in_one_sentence_that_says_what_to_connect) {
  const auto maker = autopilot_kind(heartbeat_of(13, 2));
  ASSERT_FALSE(maker);
  EXPECT_EQ(maker.error().message,
            "the autopilot is of another make (MAV_AUTOPILOT 13); connect PX4 or ArduPilot");
  const auto plane = autopilot_kind(heartbeat_of(12, 1));
  ASSERT_FALSE(plane);
  EXPECT_EQ(plane.error().message,
            "the autopilot flies no multirotor (MAV_TYPE 1); connect one that does");
}

TEST(AutopilotKind, names_modes_as_pilots_do) {
  EXPECT_EQ(mode_name(AutopilotKind::px4, 0x00060000), "offboard");
  EXPECT_EQ(mode_name(AutopilotKind::px4, 0x05040000), "return");
  EXPECT_EQ(mode_name(AutopilotKind::px4, landing_mode(AutopilotKind::px4)), "land");
  EXPECT_EQ(mode_name(AutopilotKind::ardupilot, 6), "RTL");
  EXPECT_EQ(mode_name(AutopilotKind::ardupilot, commanded_mode(AutopilotKind::ardupilot)),
            "GUIDED");
  EXPECT_EQ(mode_name(AutopilotKind::ardupilot, 99), "mode 99");
}

TEST(AutopilotKind, asks_each_for_its_mode_in_its_own_way) {
  EXPECT_EQ(command_to_be_commanded(AutopilotKind::px4).parameters[1], 6.0F);  // The main mode.
  EXPECT_EQ(command_to_be_commanded(AutopilotKind::ardupilot).parameters[1], 4.0F);
}

}  // namespace
}  // namespace flyball
