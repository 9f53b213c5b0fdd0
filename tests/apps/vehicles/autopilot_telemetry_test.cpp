// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/autopilot_telemetry.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

template <class Message>
MavlinkFrame framed(const Message& message, std::uint8_t system = 1, std::uint8_t component = 1) {
  MavlinkFrame frame;
  frame.id = Message::kind.id;
  frame.system = system;
  frame.component = component;
  const auto payload = mavlink_payload(message);
  std::copy(payload.begin(), payload.end(), frame.payload.begin());
  return frame;
}

MavHeartbeat px4_heartbeat() {
  MavHeartbeat heartbeat;
  heartbeat.autopilot = mav::autopilot_px4;
  heartbeat.type = 2;
  return heartbeat;
}

MavLocalPosition local_position(std::uint32_t boot_ms, float north_m, float north_m_s) {
  MavLocalPosition position;
  position.time_boot_ms = boot_ms;
  position.p_m[0] = north_m;
  position.v_m_s[0] = north_m_s;
  return position;
}

MavAttitudeQuaternion level(std::uint32_t boot_ms, float yaw_rate_rad_s = 0.0F) {
  MavAttitudeQuaternion attitude;
  attitude.time_boot_ms = boot_ms;
  attitude.q[0] = 1.0F;
  attitude.rates_rad_s[2] = yaw_rate_rad_s;
  return attitude;
}

AutopilotTelemetry heard_px4() {
  AutopilotTelemetry telemetry;
  telemetry.hear(framed(px4_heartbeat()), 0s);
  return telemetry;
}

TEST(AutopilotTelemetry, does_not_take_a_ground_station_or_a_gimbal_for_an_autopilot) {
  AutopilotTelemetry telemetry;
  MavHeartbeat station;
  station.autopilot = mav::autopilot_none;
  telemetry.hear(framed(station, 255, 190), 0s);
  telemetry.hear(framed(station, 1, 1), 0s);
  telemetry.hear(framed(px4_heartbeat(), 1, 154), 0s);
  EXPECT_FALSE(telemetry.kind());
  telemetry.hear(framed(px4_heartbeat(), 3, 1), 0s);
  EXPECT_TRUE(telemetry.kind());
  EXPECT_EQ(telemetry.system(), 3);
}

TEST(AutopilotTelemetry, listens_to_the_first_autopilot_alone) {
  AutopilotTelemetry telemetry = heard_px4();
  MavHeartbeat other = px4_heartbeat();
  other.base_mode = mav::flag_armed;
  telemetry.hear(framed(other, 2, 1), 1s);
  telemetry.hear(framed(local_position(0, 5.0F, 0.0F), 2, 1), 1s);
  EXPECT_FALSE(telemetry.is_armed());
  EXPECT_FALSE(telemetry.has_position());
}

TEST(AutopilotTelemetry, moves_on_for_a_quarter_of_a_second_and_no_longer) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(local_position(1000, 2.0F, 4.0F)), 1s);
  telemetry.hear(framed(level(1000, 0.5F)), 1s);
  EXPECT_TRUE(telemetry.is_fresh(1250ms));
  EXPECT_FALSE(telemetry.is_fresh(1251ms));
  EXPECT_NEAR(telemetry.motion(1100ms).X_WB.translation().y(), 2.4, 1e-6);
  EXPECT_NEAR(telemetry.motion(9s).X_WB.translation().y(), 3.0, 1e-6);
  // Facing north and turning to the right: less than a right angle from east.
  const Vec3 forward = telemetry.motion(1100ms).X_WB.linear().col(0);
  EXPECT_NEAR(yaw_of(forward), 0.5 * M_PI - 0.05, 1e-6);
}

TEST(AutopilotTelemetry, is_as_old_as_the_older_of_position_and_attitude) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(local_position(1000, 0.0F, 0.0F)), 1s);
  EXPECT_FALSE(telemetry.is_fresh(1s));
  telemetry.hear(framed(level(1000)), 1s);
  EXPECT_TRUE(telemetry.is_fresh(1s));
  telemetry.hear(framed(level(1300)), 1300ms);
  EXPECT_FALSE(telemetry.is_fresh(1300ms));
  telemetry.hear(framed(local_position(1600, 0.0F, 0.0F)), 1600ms);
  EXPECT_FALSE(telemetry.is_fresh(1600ms));
}

TEST(AutopilotTelemetry, knows_how_long_a_position_has_waited) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(level(1000)), 1s);
  telemetry.hear(framed(local_position(1000, 0.0F, 5.0F)), 1s);
  telemetry.hear(framed(local_position(1100, 0.5F, 5.0F)), 1140ms);  // 40 ms late.
  EXPECT_NEAR(telemetry.motion(1140ms).X_WB.translation().y(), 0.7, 1e-3);
}

TEST(AutopilotTelemetry, takes_the_acceleration_from_two_velocities_and_the_autopilots_clock) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(level(1000)), 1s);
  telemetry.hear(framed(local_position(1000, 0.0F, 1.0F)), 1s);
  telemetry.hear(framed(local_position(1020, 0.0F, 1.1F)), 1s);  // In a bunch with the first.
  EXPECT_NEAR(telemetry.motion(1s).a_WB.y(), 5.0, 1e-4);
  telemetry.hear(framed(local_position(2020, 0.0F, 3.0F)), 2s);  // After a pause.
  EXPECT_EQ(telemetry.motion(2s).a_WB, Vec3::Zero());
}

TEST(AutopilotTelemetry, a_jump_of_the_estimate_does_not_move_the_vehicle) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(level(1000)), 1s);
  telemetry.hear(framed(local_position(1000, 2.0F, 4.0F)), 1s);
  telemetry.place({});
  telemetry.hear(framed(local_position(1020, 12.08F, 4.0F)), 1020ms);
  EXPECT_NEAR(telemetry.motion(1020ms).X_WB.translation().y(), 2.08, 1e-5);
  EXPECT_EQ(telemetry.motion(1020ms).a_WB, Vec3::Zero());
  EXPECT_NEAR(telemetry.origin().to_N({0.0, 3.0, 0.0}).x(), 13.0, 1e-5);  // It flies there by that.
  telemetry.hear(framed(local_position(1040, 12.16F, 4.0F)), 1040ms);
  EXPECT_NEAR(telemetry.motion(1040ms).X_WB.translation().y(), 2.16, 1e-5);
  const std::vector<std::string> told = telemetry.take_news();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told.front().find("jumped by 10.0 m"), std::string::npos) << told.front();
}

TEST(AutopilotTelemetry, what_a_vehicle_can_fly_is_no_jump) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(level(1000)), 1s);
  telemetry.hear(framed(local_position(1000, 0.0F, 0.0F)), 1s);
  telemetry.place({});
  telemetry.hear(framed(local_position(1020, 0.4F, 0.4F)), 1020ms);  // A gust.
  EXPECT_NEAR(telemetry.motion(1020ms).X_WB.translation().y(), 0.4, 1e-5);
  telemetry.hear(framed(local_position(3020, 16.0F, 0.0F)), 3020ms);  // Accelerates, and brakes.
  EXPECT_NEAR(telemetry.motion(3020ms).X_WB.translation().y(), 16.0, 1e-5);
  EXPECT_TRUE(telemetry.take_news().empty());
}

TEST(AutopilotTelemetry, knows_the_power_of_a_battery_while_it_is_measured) {
  AutopilotTelemetry telemetry = heard_px4();
  EXPECT_FALSE(telemetry.battery(0s));
  MavSystemStatus status;
  telemetry.hear(framed(status), 1s);  // Without a power module.
  EXPECT_FALSE(telemetry.battery(1s));
  status.battery_mv = 22200;
  status.battery_ca = 1500;
  telemetry.hear(framed(status), 1s);
  ASSERT_TRUE(telemetry.battery(1s));
  EXPECT_NEAR(telemetry.battery(1s)->power.value(), 333.0, 1e-9);
  EXPECT_FALSE(telemetry.battery(1s)->percent);
  status.battery_percent = 83;
  telemetry.hear(framed(status), 2s);
  EXPECT_EQ(telemetry.battery(4s)->percent, 83.0);
  EXPECT_FALSE(telemetry.battery(4001ms));
}

TEST(AutopilotTelemetry, does_not_believe_what_is_not_finite_or_no_rotation) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.hear(framed(local_position(0, std::numeric_limits<float>::quiet_NaN(), 0.0F)), 1s);
  telemetry.hear(framed(MavAttitudeQuaternion{}), 1s);
  EXPECT_FALSE(telemetry.has_position());
  EXPECT_FALSE(telemetry.has_attitude());
}

TEST(AutopilotTelemetry, tells_of_silence_once_and_of_its_end) {
  AutopilotTelemetry telemetry = heard_px4();
  telemetry.look(2900ms);
  EXPECT_TRUE(telemetry.take_news().empty());
  telemetry.look(3s);
  telemetry.look(4s);
  EXPECT_EQ(telemetry.take_news(),
            std::vector<std::string>{"the autopilot has not been heard for 3 s"});
  telemetry.hear(framed(px4_heartbeat()), 5s);
  EXPECT_EQ(telemetry.take_news(),
            std::vector<std::string>{"the autopilot is heard again, after 5 s"});
}

TEST(AutopilotTelemetry, tells_of_a_line_that_drops_out_again_and_again_once_in_10_s) {
  AutopilotTelemetry telemetry = heard_px4();
  std::size_t sentences = 0;
  for (int second = 1; second <= 15; ++second) {
    const Duration now = std::chrono::seconds{second};
    telemetry.hear(framed(local_position(1000U * static_cast<std::uint32_t>(second), 0.0F, 0.0F)),
                   now);
    telemetry.hear(framed(level(1000U * static_cast<std::uint32_t>(second))), now);
    telemetry.hear(framed(px4_heartbeat()), now);
    telemetry.look(now);
    telemetry.look(now + 500ms);
    sentences += telemetry.take_news().size();
  }
  EXPECT_EQ(sentences, 4U);  // At 1 and 11 s that nothing came, and each time that it came again.
}

TEST(AutopilotTelemetry, says_once_that_signatures_are_not_checked) {
  AutopilotTelemetry telemetry;
  MavlinkFrame frame = framed(px4_heartbeat());
  frame.is_signed = true;
  telemetry.hear(frame, 0s);
  telemetry.hear(frame, 1s);
  EXPECT_EQ(telemetry.take_news().size(), 1U);
}

TEST(AutopilotTelemetry, puts_pieces_of_a_text_together_and_starts_anew_where_one_is_lost) {
  AutopilotTelemetry telemetry = heard_px4();
  MavStatusText piece;
  piece.severity = 3;
  piece.id = 5;
  piece.text.fill('a');
  telemetry.hear(framed(piece), 0s);
  EXPECT_TRUE(telemetry.take_news().empty());
  piece.id = 6;
  piece.text = {'b'};
  telemetry.hear(framed(piece), 0s);
  EXPECT_EQ(telemetry.take_news(), std::vector<std::string>{"autopilot: b"});
}

}  // namespace
}  // namespace flyball
