// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/mavlink_frame.h"

#include "flyball/runtime/assert.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr std::uint8_t magic_1 = 0xfe;
constexpr std::uint8_t magic_2 = 0xfd;
constexpr std::size_t header_1_bytes = 6;
constexpr std::size_t header_2_bytes = 10;
constexpr std::size_t checksum_bytes = 2;
constexpr std::size_t signature_bytes = 13;
constexpr std::uint8_t signed_flag = 0x01;
constexpr std::uint8_t farthest_step = 128;  // Half of the numbers lie ahead, half behind.

}  // namespace

std::uint16_t mavlink_crc(const std::uint8_t* bytes, std::size_t count, std::uint16_t crc) {
  for (std::size_t i = 0; i < count; ++i) {
    unsigned mixed = bytes[i] ^ (crc & 0xffU);
    mixed = (mixed ^ (mixed << 4U)) & 0xffU;
    crc = static_cast<std::uint16_t>((crc >> 8U) ^ (mixed << 8U) ^ (mixed << 3U) ^ (mixed >> 4U));
  }
  return crc;
}

std::vector<std::uint8_t> mavlink_bytes(const MavlinkKind& kind,
                                        const std::vector<std::uint8_t>& payload,
                                        std::uint8_t system,
                                        std::uint8_t component,
                                        std::uint8_t sequence) {
  FLYBALL_ASSERT(payload.size() == kind.length, "message %u: %zu bytes, not %d", kind.id,
                 payload.size(), int{kind.length});
  std::size_t kept = payload.size();
  while (kept > 1 && payload[kept - 1] == 0) {
    --kept;
  }
  const auto byte_of_id = [&kind](unsigned shift) {
    return static_cast<std::uint8_t>((kind.id >> shift) & 0xffU);
  };
  std::vector<std::uint8_t> bytes{magic_2,
                                  static_cast<std::uint8_t>(kept),
                                  0,
                                  0,
                                  sequence,
                                  system,
                                  component,
                                  byte_of_id(0),
                                  byte_of_id(8),
                                  byte_of_id(16)};
  bytes.insert(bytes.end(), payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(kept));
  std::uint16_t crc = mavlink_crc(bytes.data() + 1, bytes.size() - 1);
  crc = mavlink_crc(&kind.crc_extra, 1, crc);
  bytes.push_back(static_cast<std::uint8_t>(crc & 0xffU));
  bytes.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return bytes;
}

const MavlinkKind* MavlinkReader::kind_of(std::uint32_t id) const {
  const auto found = std::find_if(kinds_.begin(), kinds_.end(),
                                  [id](const MavlinkKind& kind) { return kind.id == id; });
  return found == kinds_.end() ? nullptr : &*found;
}

std::optional<MavlinkReader::Header> MavlinkReader::header_at(std::size_t at) const {
  const std::uint8_t* bytes = waiting_.data() + at;
  const std::size_t left = waiting_.size() - at;
  const bool is_2 = bytes[0] == magic_2;
  if (!is_2 && bytes[0] != magic_1) {
    return Header{};
  }
  Header header;
  header.size = is_2 ? header_2_bytes : header_1_bytes;
  if (left < header.size) {
    return std::nullopt;
  }
  header.payload = bytes[1];
  header.whole = header.size + header.payload + checksum_bytes;
  MavlinkFrame& frame = header.frame;
  if (is_2) {
    if ((bytes[2] & ~signed_flag) != 0) {  // Flags that change the format, and that nobody knows.
      return Header{};
    }
    frame.is_signed = bytes[2] == signed_flag;
    header.whole += frame.is_signed ? signature_bytes : 0;
    frame.id = bytes[7] | (unsigned{bytes[8]} << 8U) | (unsigned{bytes[9]} << 16U);
  } else {
    frame.id = bytes[5];
  }
  const std::uint8_t* sender = bytes + (is_2 ? 4 : 2);
  frame.sequence = sender[0];
  frame.system = sender[1];
  frame.component = sender[2];
  return header;
}

bool MavlinkReader::is_intact(std::size_t at, const Header& header, const MavlinkKind& kind) const {
  const std::uint8_t* bytes = waiting_.data() + at;
  const std::size_t end = header.size + header.payload;
  std::uint16_t crc = mavlink_crc(bytes + 1, end - 1);
  crc = mavlink_crc(&kind.crc_extra, 1, crc);
  return bytes[end] == (crc & 0xffU) && bytes[end + 1] == (crc >> 8U);
}

/// An unchecked frame goes on with the numbers of a sender, but is not believed to be a new one.
void MavlinkReader::count_gap(const MavlinkFrame& frame, bool is_checked) {
  const auto sender = std::make_pair(frame.system, frame.component);
  const auto last = last_sequences_.find(sender);
  if (last != last_sequences_.end()) {
    const auto step = static_cast<std::uint8_t>(frame.sequence - last->second);
    if (step > 0 && step < farthest_step) {  // Else it is the same frame again, or an older one.
      counts_.lost += step - 1U;
      last->second = frame.sequence;
    }
  } else if (is_checked) {
    last_sequences_[sender] = frame.sequence;
  }
}

std::vector<MavlinkFrame> MavlinkReader::read(const std::uint8_t* bytes, std::size_t count) {
  waiting_.insert(waiting_.end(), bytes, bytes + count);
  std::vector<MavlinkFrame> frames;
  std::size_t at = 0;
  while (at < waiting_.size()) {
    std::optional<Header> header = header_at(at);
    if (!header || waiting_.size() - at < header->whole) {
      break;
    }
    const MavlinkKind* kind = header->whole > 0 ? kind_of(header->frame.id) : nullptr;
    const bool is_bad = kind != nullptr && !is_intact(at, *header, *kind);
    counts_.bad_checksums += is_bad ? 1U : 0U;
    // What cannot be checked is believed to be a frame only where one is bound to begin.
    if (header->whole == 0 || is_bad || (kind == nullptr && !is_in_step_)) {
      ++counts_.skipped_bytes;
      ++at;
      is_in_step_ = false;
      continue;
    }
    is_in_step_ = true;
    count_gap(header->frame, kind != nullptr);
    if (kind != nullptr) {
      ++counts_.frames;
      const auto from = waiting_.begin() + static_cast<std::ptrdiff_t>(at + header->size);
      std::copy(from, from + static_cast<std::ptrdiff_t>(header->payload),
                header->frame.payload.begin());
      frames.push_back(header->frame);
    }
    at += header->whole;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
  return frames;
}

}  // namespace flyball
