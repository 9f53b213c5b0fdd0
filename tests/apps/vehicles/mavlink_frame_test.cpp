// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/mavlink_frame.h"

#include "vehicles/mavlink_messages.h"
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Bytes = std::vector<std::uint8_t>;

// As node-mavlink 2.3.0 writes them: a PX4 quadrotor, armed, in mode offboard.
const Bytes& heartbeat_1() {
  static const Bytes bytes{0xfe, 0x09, 0x07, 0x01, 0x01, 0x00, 0x00, 0x00, 0x06,
                           0x00, 0x02, 0x0c, 0xd1, 0x04, 0x03, 0xd9, 0xf7};
  return bytes;
}
const Bytes& heartbeat_2() {
  static const Bytes bytes{0xfd, 0x09, 0x00, 0x00, 0x07, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00,
                           0x00, 0x06, 0x00, 0x02, 0x0c, 0xd1, 0x04, 0x03, 0x87, 0xf6};
  return bytes;
}

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

std::vector<MavlinkFrame> read(MavlinkReader& reader, const Bytes& bytes) {
  return reader.read(bytes.data(), bytes.size());
}

MavlinkReader reader_of_all() {
  return MavlinkReader{kinds_from_autopilot()};
}

TEST(MavlinkFrame, checksum_is_that_of_the_published_check_value) {
  const std::string digits = "123456789";  // CRC-16/MCRF4XX, check 0x6f91.
  const Bytes bytes{digits.begin(), digits.end()};
  EXPECT_EQ(mavlink_crc(bytes.data(), bytes.size()), 0x6f91);
}

TEST(MavlinkFrame, reads_both_versions_as_another_library_writes_them) {
  for (const Bytes& bytes : {heartbeat_1(), heartbeat_2()}) {
    MavlinkReader reader = reader_of_all();
    const auto frames = read(reader, bytes);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].sequence, 7);
    EXPECT_EQ(frames[0].system, 1);
    EXPECT_FALSE(frames[0].is_signed);
    const auto heartbeat = mavlink_message<MavHeartbeat>(frames[0]);
    EXPECT_EQ(heartbeat.custom_mode, 0x60000U);
    EXPECT_EQ(heartbeat.type, 2);
    EXPECT_EQ(heartbeat.autopilot, 12);
    EXPECT_EQ(heartbeat.base_mode, 209);
  }
}

TEST(MavlinkFrame, writes_the_bytes_that_another_library_writes) {
  MavHeartbeat heartbeat;
  heartbeat.custom_mode = 0x60000;
  heartbeat.type = 2;
  heartbeat.autopilot = 12;
  heartbeat.base_mode = 209;
  heartbeat.system_status = 4;
  EXPECT_EQ(mavlink_bytes(MavHeartbeat::kind, mavlink_payload(heartbeat), 1, 1, 7), heartbeat_2());
}

TEST(MavlinkFrame, leaves_out_zeros_at_the_end_and_puts_them_back) {
  MavLocalPosition position;
  position.time_boot_ms = 5;
  position.p_m = {1.5F, 0.0F, 0.0F};
  const Bytes bytes = mavlink_bytes(MavLocalPosition::kind, mavlink_payload(position), 1, 1, 0);
  EXPECT_EQ(bytes[1], 8);  // Time, and north.
  MavlinkReader reader = reader_of_all();
  const auto frames = read(reader, bytes);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(mavlink_message<MavLocalPosition>(frames[0]).p_m, position.p_m);
  const Bytes nothing = mavlink_bytes(MavExtendedState::kind, {0, 0}, 1, 1, 0);
  EXPECT_EQ(nothing[1], 1);  // One byte stays.
}

/// The same with other flags for the format, and the checksum that belongs to them.
Bytes heartbeat_with_flags(std::uint8_t flags) {
  Bytes bytes = heartbeat_2();
  bytes.resize(bytes.size() - 2);
  bytes[2] = flags;
  std::uint16_t crc = mavlink_crc(bytes.data() + 1, bytes.size() - 1);
  crc = mavlink_crc(&MavHeartbeat::kind.crc_extra, 1, crc);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xffU));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return bytes;
}

TEST(MavlinkFrame, skips_a_signature_and_says_that_there_was_one) {
  Bytes bytes = heartbeat_with_flags(1);
  bytes.insert(bytes.end(), 13, 0xfd);  // A signature may look like frames' beginnings.
  MavlinkReader reader = reader_of_all();
  const auto frames = read(reader, joined({bytes, heartbeat_2()}));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(frames[0].is_signed);
  EXPECT_FALSE(frames[1].is_signed);
  EXPECT_EQ(reader.counts().skipped_bytes, 0U);
}

TEST(MavlinkFrame, takes_frames_apart_wherever_the_bytes_are_cut) {
  MavlinkReader reader = reader_of_all();
  std::size_t found = 0;
  for (const std::uint8_t byte : joined({heartbeat_1(), heartbeat_2(), heartbeat_1()})) {
    found += reader.read(&byte, 1).size();
  }
  EXPECT_EQ(found, 3U);
}

TEST(MavlinkFrame, a_damaged_byte_costs_its_own_frame_and_no_other) {
  for (const Bytes& whole : {heartbeat_1(), heartbeat_2()}) {
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const int damage : {0x01, 0x80, 0xff}) {
        Bytes damaged = whole;
        damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ damage);
        MavlinkReader reader = reader_of_all();
        Bytes stream = joined({damaged, heartbeat_2()});
        // A wrong length waits for bytes that are not its own: as many as the longest frame has.
        stream.insert(stream.end(), 300, 0x00);
        const auto frames = read(reader, stream);
        ASSERT_EQ(frames.size(), 1U) << "byte " << at << " xor " << damage;
        EXPECT_EQ(mavlink_message<MavHeartbeat>(frames[0]).base_mode, 209);
      }
    }
  }
}

TEST(MavlinkFrame, finds_frames_again_behind_rubbish) {
  Bytes rubbish;
  for (int i = 0; i < 400; ++i) {
    rubbish.push_back(static_cast<std::uint8_t>((i * 37) % 0xfd));  // No byte begins a frame.
  }
  MavlinkReader reader = reader_of_all();
  EXPECT_EQ(read(reader, joined({rubbish, heartbeat_1(), rubbish, heartbeat_2()})).size(), 2U);
  EXPECT_EQ(reader.counts().skipped_bytes, 800U);
}

TEST(MavlinkFrame, a_part_of_a_damaged_frame_does_not_swallow_the_next_one) {
  // In the payload stands what looks like the beginning of a long frame of an unknown kind.
  Bytes damaged = heartbeat_2();
  const Bytes looks{0xfd, 0x60, 0x00, 0x00, 0x01, 0x01, 0x01, 0x77};
  std::copy(looks.begin(), looks.end(), damaged.begin() + 10);
  MavlinkReader reader = reader_of_all();
  Bytes stream = joined({damaged, heartbeat_2(), heartbeat_1()});
  stream.insert(stream.end(), 100, 0x00);
  EXPECT_EQ(read(reader, stream).size(), 2U);
  EXPECT_EQ(reader.counts().bad_checksums, 1U);
}

TEST(MavlinkFrame, passes_over_messages_that_it_was_not_told_of) {
  MavlinkReader reader{{MavLocalPosition::kind}};
  MavLocalPosition position;
  position.time_boot_ms = 5;
  const Bytes known = mavlink_bytes(MavLocalPosition::kind, mavlink_payload(position), 1, 1, 8);
  EXPECT_EQ(read(reader, joined({heartbeat_2(), known})).size(), 1U);
  EXPECT_EQ(reader.counts().bad_checksums, 0U);
}

TEST(MavlinkFrame, refuses_flags_that_change_the_format) {
  MavlinkReader reader = reader_of_all();
  EXPECT_TRUE(read(reader, heartbeat_with_flags(2)).empty());
  EXPECT_EQ(read(reader, heartbeat_with_flags(0)).size(), 1U);
}

TEST(MavlinkFrame, counts_the_numbers_that_never_came) {
  MavlinkReader reader = reader_of_all();
  const auto numbered = [](std::uint8_t sequence, std::uint8_t component) {
    return mavlink_bytes(MavHeartbeat::kind, mavlink_payload(MavHeartbeat{}), 1, component,
                         sequence);
  };
  (void)read(reader, joined({numbered(254, 1), numbered(255, 1), numbered(0, 1)}));
  EXPECT_EQ(reader.counts().lost, 0U);
  (void)read(reader, joined({numbered(3, 1), numbered(3, 1), numbered(2, 1), numbered(4, 1)}));
  EXPECT_EQ(reader.counts().lost, 2U);  // 1 and 2; a repeated one and a late one are none.
  (void)read(reader, joined({numbered(90, 7), numbered(5, 1)}));
  EXPECT_EQ(reader.counts().lost, 2U);  // Another sender counts for itself.
}

}  // namespace
}  // namespace flyball
