// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Writes protobuf messages to an MCAP file, which opens in Foxglove: https://mcap.dev/spec

#include "flyball/mcap/message_schema.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

struct McapChannel {
  std::string topic{};   ///< `/pose`
  std::string schema{};  ///< `foxglove.PoseInFrame`
};

struct McapSettings {
  std::vector<MessageSchema> schemas{};  ///< Those of the channels, and what they consist of.
  std::vector<McapChannel> channels{};   ///< At most 65535; a message names one by its place here.
  std::size_t chunk_bytes{std::size_t{1} << 20U};  ///< A chunk that is so large is closed, ...
  Duration chunk_time{std::chrono::seconds{1}};    ///< ... and one that is so long.
  /// Each chunk is on the disk before the next one is begun: a loss of power takes one chunk.
  bool survives_power_loss{};
};

/// Messages are gathered in a chunk, which is compressed with zstd and written in one piece when it
/// is closed: whatever happens, a file holds all chunks that were closed (`recover_mcap`). The file
/// has an index of its chunks, and of the messages in each, and checksums of everything.
///
/// Needs the memory of a chunk three times, and 60 bytes and 12 for each channel for every chunk
/// that it has written. The same calls give the same bytes. One thread at a time may use it.
class McapWriter {
 public:
  /// Creates or replaces the file.
  /// @error `unavailable`: it cannot be made there.
  static Result<std::unique_ptr<McapWriter>> open(const std::string& path,
                                                  const McapSettings& settings);
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Adds one message; before that, closes a chunk that is older than `chunk_time` by `at`.
  /// @param sequence  Of this channel, from 0: a gap says that messages were dropped.
  /// @pre `channel` is one of the settings'.
  void add(std::size_t channel, std::uint32_t sequence, MissionTime at, std::string_view message);
  [[nodiscard]] bool has_open_chunk() const;
  /// Writes what has been added. Without an open chunk: nothing.
  void close_chunk();
  /// A table of texts; each has a name.
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& values);
  /// Closes the chunk, and writes the index. To be called once, last.
  /// @error `failed`: this write or an earlier one was refused.
  Status close();

  /// The first error; nothing is written after it.
  [[nodiscard]] Status status() const;
  [[nodiscard]] std::size_t chunks() const;  ///< That were closed.

 private:
  struct Parts;
  explicit McapWriter(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace flyball
