// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The records of an MCAP file: https://mcap.dev/spec

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flyball {

inline constexpr std::string_view mcap_magic{"\x89MCAP0\r\n", 8};
inline constexpr std::size_t mcap_record_head_bytes = 9;  ///< McapOpcode and length.
inline constexpr std::string_view mcap_zstd{"zstd"};

enum class McapOpcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0b,
  metadata = 0x0c,
  metadata_index = 0x0d,
  summary_offset = 0x0e,
  data_end = 0x0f,
};

/// CRC-32 as in ISO 3309, which zlib computes too. Goes on from the CRC of what stands before.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// Writes one record's content; numbers are little-endian.
class McapPacker {
 public:
  template <class T>
  McapPacker& number(T value) {
    for (unsigned byte = 0; byte < sizeof(T); ++byte) {
      bytes_.push_back(
          static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * byte)) & 0xffU));
    }
    return *this;
  }
  McapPacker& raw(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  McapPacker& text(std::string_view value) {
    return number(static_cast<std::uint32_t>(value.size())).raw(value);
  }
  McapPacker& map(const std::map<std::string, std::string>& values);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_{};
};

/// Appends a record to `out`.
void append_record(std::string& out, McapOpcode opcode, std::string_view content);

/// Reads one record's content. After the end all reads are empty, and `is_good()` is false.
class McapUnpacker {
 public:
  explicit McapUnpacker(std::string_view bytes) : bytes_{bytes} {}
  template <class T>
  T number() {
    const std::string_view part = raw(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t byte = 0; byte < part.size(); ++byte) {
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(part[byte])) << (8 * byte);
    }
    return static_cast<T>(value);
  }
  std::string_view raw(std::uint64_t size) {
    if (size > bytes_.size()) {
      is_good_ = false;
      bytes_ = {};
      return {};
    }
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  std::string_view text() { return raw(number<std::uint32_t>()); }
  std::map<std::string, std::string> map();
  [[nodiscard]] std::string_view rest() const { return bytes_; }
  [[nodiscard]] bool is_good() const { return is_good_; }

 private:
  std::string_view bytes_;
  bool is_good_{true};
};

/// One record as it stands in the file.
struct McapRecord {
  McapOpcode opcode{};
  std::string_view content{};
};
/// Takes the next record off the front of `bytes`; empty when no whole record is left.
[[nodiscard]] std::optional<McapRecord> take_record(std::string_view& bytes);

/// Where messages lie in a chunk: time and offset, for each channel.
using MessageOffsets =
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>>;

/// What a chunk says of itself. Times are nanoseconds.
struct ChunkHead {
  std::uint64_t begin_ns{};
  std::uint64_t end_ns{};
  std::uint64_t uncompressed_bytes{};
  std::uint32_t crc{};  ///< Of what is in it, uncompressed.
};

/// Where a chunk stands in the file.
struct ChunkPlace {
  ChunkHead head{};
  std::uint64_t offset{};
  std::uint64_t bytes{};  ///< Of the whole record.
  std::uint64_t compressed_bytes{};
  std::map<std::uint16_t, std::uint64_t> index_offsets{};  ///< Of the message index, by channel.
  std::uint64_t index_bytes{};                             ///< Of all these together.
};

[[nodiscard]] std::string index_record(const ChunkPlace& place);

}  // namespace flyball
