// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/mavlink_messages.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

template <class Message>
Message through_bytes(const Message& message) {
  const auto bytes = mavlink_bytes(Message::kind, mavlink_payload(message), 1, 1, 0);
  MavlinkReader reader{{Message::kind}};
  const auto frames = reader.read(bytes.data(), bytes.size());
  EXPECT_EQ(frames.size(), 1U);
  return frames.empty() ? Message{} : mavlink_message<Message>(frames[0]);
}

template <class Message>
void has_the_length_of_its_kind() {
  EXPECT_EQ(mavlink_payload(Message{}).size(), Message::kind.length) << Message::kind.id;
}

TEST(MavlinkMessages, have_the_lengths_that_they_say) {
  has_the_length_of_its_kind<MavHeartbeat>();
  has_the_length_of_its_kind<MavSystemStatus>();
  has_the_length_of_its_kind<MavParamRequestRead>();
  has_the_length_of_its_kind<MavParamValue>();
  has_the_length_of_its_kind<MavAttitudeQuaternion>();
  has_the_length_of_its_kind<MavLocalPosition>();
  has_the_length_of_its_kind<MavCommandLong>();
  has_the_length_of_its_kind<MavCommandAck>();
  has_the_length_of_its_kind<MavPositionTarget>();
  has_the_length_of_its_kind<MavExtendedState>();
  has_the_length_of_its_kind<MavStatusText>();
}

TEST(MavlinkMessages, stand_in_the_order_of_the_standard) {
  // LOCAL_POSITION_NED as node-mavlink 2.3.0 writes it: 123456 ms, (1.5, -2.25, -3.75) m,
  // (.5, -.25, 0) m/s.
  const std::vector<std::uint8_t> bytes{0xfd, 0x18, 0x00, 0x00, 0xc8, 0x01, 0x01, 0x20, 0x00,
                                        0x00, 0x40, 0xe2, 0x01, 0x00, 0x00, 0x00, 0xc0, 0x3f,
                                        0x00, 0x00, 0x10, 0xc0, 0x00, 0x00, 0x70, 0xc0, 0x00,
                                        0x00, 0x00, 0x3f, 0x00, 0x00, 0x80, 0xbe, 0x62, 0x3d};
  MavlinkReader reader{{MavLocalPosition::kind}};
  const auto frames = reader.read(bytes.data(), bytes.size());
  ASSERT_EQ(frames.size(), 1U);
  const auto position = mavlink_message<MavLocalPosition>(frames[0]);
  EXPECT_EQ(position.time_boot_ms, 123456U);
  EXPECT_EQ(position.p_m, (std::array<float, 3>{1.5F, -2.25F, -3.75F}));
  EXPECT_EQ(position.v_m_s, (std::array<float, 3>{0.5F, -0.25F, 0.0F}));
}

TEST(MavlinkMessages, keep_negative_numbers_and_words) {
  MavParamRequestRead request;
  request.name = {'G', 'U', 'I', 'D', '_', 'T', 'I', 'M', 'E', 'O', 'U', 'T'};
  const MavParamRequestRead read = through_bytes(request);
  EXPECT_EQ(read.index, -1);
  EXPECT_EQ(mavlink_text(read.name), "GUID_TIMEOUT");
  MavStatusText text;
  text.text.fill('x');  // Fifty letters have no zero behind them.
  EXPECT_EQ(mavlink_text(through_bytes(text).text), std::string(50, 'x'));
}

TEST(MavlinkMessages, results_have_names) {
  EXPECT_EQ(mavlink_result_name(0), "ACCEPTED");
  EXPECT_EQ(mavlink_result_name(2), "DENIED");
  EXPECT_EQ(mavlink_result_name(5), "IN_PROGRESS");
  EXPECT_EQ(mavlink_result_name(77), "result 77");
}

TEST(MavlinkMessages, reads_a_message_that_has_grown_since) {
  MavSystemStatus status;
  status.battery_mv = 22200;
  status.battery_percent = 83;
  std::vector<std::uint8_t> payload = mavlink_payload(status);
  payload.insert(payload.end(), {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});  // Three more fields.
  const MavlinkKind grown{1, 43, 124};
  const auto bytes = mavlink_bytes(grown, payload, 1, 1, 0);
  MavlinkReader reader{kinds_from_autopilot()};
  const auto frames = reader.read(bytes.data(), bytes.size());
  ASSERT_EQ(frames.size(), 1U);
  const auto heard = mavlink_message<MavSystemStatus>(frames.front());
  EXPECT_EQ(heard.battery_mv, 22200);
  EXPECT_EQ(heard.battery_percent, 83);
}

}  // namespace
}  // namespace flyball
