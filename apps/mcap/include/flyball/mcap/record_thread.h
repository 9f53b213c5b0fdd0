// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A record that is written while the program has better things to do.

#include "flyball/mcap/mcap_writer.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace flyball {

/// What happens to a row for which there is no room.
enum class WhenFull : std::uint8_t {
  drop,  ///< It is lost and counted: for real time.
  wait,  ///< Who adds it waits: for simulated time, where every run must leave the same bytes.
};

struct RecordThreadSettings {
  McapSettings file{};
  WhenFull when_full{WhenFull::drop};
  /// Rows that wait to be written take so much at most; a power of two. Chosen: seconds of rows,
  /// for a disk that stops for that long.
  std::size_t queue_bytes{std::size_t{4} << 20U};
  /// How many rows of `add_later` may wait.
  std::size_t most_later{4};
};

struct RecordCounts {
  std::uint64_t written{};
  std::uint64_t dropped{};
  std::map<std::string, std::uint64_t> dropped_by_topic{};  ///< Of those that lost any.
};

/// Rows go into a queue, from which a thread of its own compresses and writes them. Adding a row
/// never waits under `WhenFull::drop`, and does not call the system until the queue is half full.
/// The writing thread then also closes a chunk that has been open for `McapSettings::chunk_time`,
/// and leaves the processor to whoever else wants it.
///
/// Under `WhenFull::wait` the file depends on the rows and their times alone.
///
/// Rows are added by one thread at a time.
class RecordThread {
 public:
  /// Creates or replaces the file, and starts the thread.
  /// @error Those of `McapWriter::open`.
  /// @pre `queue_bytes` is a power of two.
  static Result<std::unique_ptr<RecordThread>> open(
      const std::string& path,
      const RecordThreadSettings& settings,
      const std::map<std::string, std::map<std::string, std::string>>& metadata = {});
  /// Ends the file, unless `close` has.
  ~RecordThread();
  RecordThread(const RecordThread&) = delete;
  RecordThread& operator=(const RecordThread&) = delete;

  /// False when the row was dropped: a full queue, or one that it could never fit into.
  /// @pre `channel` is one of the settings'.
  bool add(std::size_t channel, MissionTime at, std::string_view message);
  /// A row that the writing thread makes when its turn comes, because that takes long.
  /// @param make  What it refers to must not change any more, and is let go afterwards.
  bool add_later(std::size_t channel, MissionTime at, std::function<std::string()> make);

  /// Writes all that was added, the counts as metadata `flyball.record`, and the index. Rows that
  /// are added afterwards are dropped.
  /// @error That of `McapWriter::close`.
  Status close();
  /// Complete after `close`; before it, only what was dropped so far.
  [[nodiscard]] RecordCounts counts() const;

 private:
  struct Parts;
  explicit RecordThread(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace flyball
