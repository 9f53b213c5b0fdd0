// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// MAVLink frames: bytes in, checked messages out, and the other way round. Format, checksum and
/// truncation: mavlink.io/en/guide/serialization.html.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace flyball {

/// What the receiver of a message has to know before it can check it.
struct MavlinkKind {
  std::uint32_t id{};
  std::uint8_t length{};     ///< Of the payload, with the fields that MAVLink 2 added.
  std::uint8_t crc_extra{};  ///< A hash of the fields; both sides add it to the checksum.
};

/// One message. Bytes that the sender left out, because they are zero, are zero here.
struct MavlinkFrame {
  std::uint32_t id{};
  std::uint8_t system{};
  std::uint8_t component{};
  std::uint8_t sequence{};
  bool is_signed{};  ///< The signature has not been checked: nobody here has its key.
  std::array<std::uint8_t, 255> payload{};
};

/// CRC-16/MCRF4XX of `count` bytes, continued from `crc`.
[[nodiscard]] std::uint16_t mavlink_crc(const std::uint8_t* bytes,
                                        std::size_t count,
                                        std::uint16_t crc = 0xffff);

/// A frame of MAVLink 2 without signature. The payload's zeros at its end are left out, as the
/// standard demands.
/// @pre `payload` has the length of `kind`.
[[nodiscard]] std::vector<std::uint8_t> mavlink_bytes(const MavlinkKind& kind,
                                                      const std::vector<std::uint8_t>& payload,
                                                      std::uint8_t system,
                                                      std::uint8_t component,
                                                      std::uint8_t sequence);

/// What a reader has seen so far.
struct MavlinkCounts {
  std::uint64_t frames{};         ///< With a right checksum.
  std::uint64_t bad_checksums{};  ///< Of kinds that are known.
  std::uint64_t lost{};           ///< Frames of known senders whose sequence numbers never came.
  std::uint64_t skipped_bytes{};  ///< That belong to no frame.
};

/// Finds the frames of MAVLink 1 and 2 in a stream of bytes. After rubbish it tries each byte that
/// may begin a frame, so that a damaged frame costs no other one.
class MavlinkReader {
 public:
  /// @param kinds  Messages that are wanted. Others cannot be checked, and are left out.
  explicit MavlinkReader(std::vector<MavlinkKind> kinds) : kinds_{std::move(kinds)} {}

  /// Takes in what arrived and returns the frames that are complete by now.
  [[nodiscard]] std::vector<MavlinkFrame> read(const std::uint8_t* bytes, std::size_t count);
  [[nodiscard]] const MavlinkCounts& counts() const { return counts_; }

 private:
  struct Header {
    std::size_t size{};   ///< Of the header [bytes].
    std::size_t whole{};  ///< Of the frame.
    std::size_t payload{};
    MavlinkFrame frame{};
  };
  /// Empty while bytes of the header are missing. A `whole` of 0: no frame begins here.
  [[nodiscard]] std::optional<Header> header_at(std::size_t at) const;
  [[nodiscard]] const MavlinkKind* kind_of(std::uint32_t id) const;
  [[nodiscard]] bool is_intact(std::size_t at, const Header& header, const MavlinkKind& kind) const;
  void count_gap(const MavlinkFrame& frame, bool is_checked);

  std::vector<MavlinkKind> kinds_;
  std::vector<std::uint8_t> waiting_{};  ///< Bytes that may still become a frame.
  std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> last_sequences_{};
  bool is_in_step_{true};  ///< The next byte follows a frame.
  MavlinkCounts counts_{};
};

}  // namespace flyball
