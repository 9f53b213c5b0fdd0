// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Rows whose content nobody can compress, and what a file should hold of them.

#include "flyball/mcap/mcap_writer.h"
#include "flyball/mcap/protobuf.h"
#include "flyball/runtime/random.h"

#include "mcap_reader.h"
#include <string>
#include <vector>

namespace flyball {

inline std::vector<MessageSchema> made_schemas() {
  return {{"made.Vector", {{"x", FieldType::real}, {"y", FieldType::real}}, {}},
          {"made.Row",
           {{"place", FieldType::message, "made.Vector"},
            {"name", FieldType::text},
            {"noise", FieldType::bytes},
            {"kind", FieldType::choice, "Kind"},
            {"counts", FieldType::uint64, "", true}},
           {{"Kind", {"NONE", "SMALL", "LARGE"}}}}};
}

inline McapSettings made_settings() {
  McapSettings settings;
  settings.schemas = made_schemas();
  settings.channels = {{"/rows", "made.Row"}, {"/places", "made.Vector"}, {"/silent", "made.Row"}};
  return settings;
}

/// A row of channel `i % 2`, `every_ms` after the one before.
struct MadeRow {
  std::size_t channel{};
  std::uint32_t sequence{};
  MissionTime at{};
  std::string bytes{};
};

inline std::vector<MadeRow> made_rows(int count, int every_ms, std::size_t noise_bytes) {
  RandomStream random{1, "made_rows"};
  std::vector<MadeRow> rows;
  for (int i = 0; i < count; ++i) {
    MadeRow row;
    row.channel = static_cast<std::size_t>(i % 2);
    row.sequence = static_cast<std::uint32_t>(i / 2);
    row.at = MissionTime{std::chrono::milliseconds{every_ms} * i};
    const Protobuf place = Protobuf{}.real(1, i).real(2, -0.5 * i);
    if (row.channel == 1) {
      row.bytes = place.bytes();
    } else {
      std::string noise(noise_bytes, '\0');
      for (char& byte : noise) {
        byte = static_cast<char>(random.uniform(-128.0, 127.9));
      }
      row.bytes = Protobuf{}
                      .message(1, place)
                      .text(2, "row " + std::to_string(i))
                      .text(3, noise)
                      .number(4, 2)
                      .number(5, 7)
                      .number(5, static_cast<std::uint64_t>(i) << 20U)
                      .bytes();
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// As a reader sees them.
inline std::vector<McapReader::Message> as_read(const std::vector<MadeRow>& rows) {
  std::vector<McapReader::Message> all;
  const McapSettings settings = made_settings();
  for (const MadeRow& row : rows) {
    all.push_back({settings.channels[row.channel].topic, row.sequence,
                   static_cast<std::uint64_t>(row.at.time_since_epoch().count()), row.bytes});
  }
  return all;
}

inline std::string listed(const std::vector<std::string>& faults) {
  std::string all;
  for (const std::string& one : faults) {
    all += one + "\n";
  }
  return all;
}

}  // namespace flyball
