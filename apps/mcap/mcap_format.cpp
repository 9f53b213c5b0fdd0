// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mcap_writer
#include "mcap/mcap_format.h"

namespace flyball {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value & 1U) != 0 ? 0xedb88320U ^ (value >> 1U) : value >> 1U;
    }
    table[i] = value;
  }
  return table;
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  static constexpr std::array<std::uint32_t, 256> table = crc_table();
  std::uint32_t crc = ~before;
  for (const char byte : bytes) {
    crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xffU] ^ (crc >> 8U);
  }
  return ~crc;
}

McapPacker& McapPacker::map(const std::map<std::string, std::string>& values) {
  McapPacker all;
  for (const auto& [key, value] : values) {
    all.text(key).text(value);
  }
  return text(all.bytes());
}

void append_record(std::string& out, McapOpcode opcode, std::string_view content) {
  out += McapPacker{}
             .number(static_cast<std::uint8_t>(opcode))
             .number(static_cast<std::uint64_t>(content.size()))
             .bytes();
  out += content;
}

std::map<std::string, std::string> McapUnpacker::map() {
  McapUnpacker all{text()};
  std::map<std::string, std::string> values;
  while (all.is_good() && !all.rest().empty()) {
    const std::string_view key = all.text();
    const std::string_view value = all.text();
    values.emplace(key, value);
  }
  is_good_ = is_good_ && all.is_good();
  return values;
}

std::optional<McapRecord> take_record(std::string_view& bytes) {
  McapUnpacker in{bytes};
  const auto opcode = in.number<std::uint8_t>();
  const auto size = in.number<std::uint64_t>();
  const std::string_view content = in.raw(size);
  if (!in.is_good()) {
    return std::nullopt;
  }
  bytes = in.rest();
  return McapRecord{static_cast<McapOpcode>(opcode), content};
}

std::string index_record(const ChunkPlace& place) {
  McapPacker offsets;
  for (const auto& [channel, offset] : place.index_offsets) {
    offsets.number(channel).number(offset);
  }
  McapPacker content;
  content.number(place.head.begin_ns)
      .number(place.head.end_ns)
      .number(place.offset)
      .number(place.bytes)
      .text(offsets.bytes())
      .number(place.index_bytes)
      .text(mcap_zstd)
      .number(place.compressed_bytes)
      .number(place.head.uncompressed_bytes);
  std::string out;
  append_record(out, McapOpcode::chunk_index, content.bytes());
  return out;
}

}  // namespace flyball
