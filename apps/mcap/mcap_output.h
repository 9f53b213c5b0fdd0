// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Puts chunks into an MCAP file, and behind them the summary by which readers find them.

#include "flyball/runtime/result.h"

#include "mcap/mcap_format.h"
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// After the first write that fails nothing more is written, and `status` says why.
class McapOutput {
 public:
  /// Creates or replaces the file.
  /// @error `unavailable`: it cannot be made there.
  static Result<std::unique_ptr<McapOutput>> open(const std::string& path);
  ~McapOutput();
  McapOutput(const McapOutput&) = delete;
  McapOutput& operator=(const McapOutput&) = delete;

  /// Contents of records Schema and Channel. Before the chunks whose messages they describe.
  void add_schema(std::string_view content) { add_description(McapOpcode::schema, content); }
  void add_channel(std::string_view content) { add_description(McapOpcode::channel, content); }
  /// @param compressed  By zstd.
  /// @param offsets     Of every message in it.
  void add_chunk(const ChunkHead& head, std::string_view compressed, const MessageOffsets& offsets);
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& values);
  /// Sees to it that what was written survives a loss of power.
  void sync();
  /// Writes the summary, which survives a loss of power if `syncs`, and closes the file. To be
  /// called once, last.
  Status finish(bool syncs);

  [[nodiscard]] const Status& status() const { return status_; }
  [[nodiscard]] std::uint64_t messages() const { return messages_; }
  [[nodiscard]] std::size_t chunks() const { return chunks_.size(); }

 private:
  struct MetadataPlace {
    std::string name{};
    std::uint64_t offset{};
    std::uint64_t bytes{};
  };
  McapOutput(std::string path, int descriptor);
  void add_description(McapOpcode opcode, std::string_view content);
  void write(std::string_view bytes);
  [[nodiscard]] std::string statistics() const;
  [[nodiscard]] std::string summary() const;

  std::string path_;
  int descriptor_;
  Status status_{Done{}};
  std::uint64_t offset_{};  ///< Bytes written.
  std::uint32_t crc_{};     ///< Of these.
  std::string buffer_{};    ///< Of one chunk, with its indexes.
  std::string schemas_{};   ///< Whole records, for the summary.
  std::string channels_{};
  std::uint16_t schema_count_{};
  std::uint32_t channel_count_{};
  std::vector<ChunkPlace> chunks_{};
  std::vector<MetadataPlace> metadata_{};
  std::uint64_t messages_{};
  std::map<std::uint16_t, std::uint64_t> channel_messages_{};
};

}  // namespace flyball
