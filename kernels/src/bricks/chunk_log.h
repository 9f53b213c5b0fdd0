// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A file of what a brick map has forgotten, so that memory is bounded and nothing is lost. It is
/// written in flight, a chunk at a time, and read once, when the whole map is wanted. Nobody but
/// the process that made it can use it, and it goes with the log.

#include "flyball/runtime/result.h"

#include "brick_map.h"
#include <fstream>
#include <string>
#include <vector>

namespace flyball {

class ChunkLog {
 public:
  /// Replaces what is there.
  explicit ChunkLog(std::string path);
  ~ChunkLog();
  ChunkLog(const ChunkLog&) = delete;
  ChunkLog& operator=(const ChunkLog&) = delete;

  /// @error `failed` when the file could not be made or written until now.
  [[nodiscard]] Status status() const;
  void append(const Chunk& chunk);
  /// As BrickMap::forget_occupied, of what was written until now.
  void forget_occupied(const Vec3& p_W, double radius_m);
  [[nodiscard]] bool is_empty() const { return chunks_ == 0; }

  /// Adds all that was written, to a map with log-odds. Where the map knows a cell already,
  /// evidence adds up.
  ///
  /// @error `failed` when the file cannot be read to its end; the map then has a part of it.
  [[nodiscard]] Status add_to(BrickMap& map);

 private:
  std::string path_;
  std::ofstream file_;
  std::size_t chunks_{};
  struct Doubt {
    Vec3 p_W;
    double radius_m;
    std::size_t after;  ///< So many chunks.
  };
  std::vector<Doubt> doubts_{};
};

/// Adds the known cells of a chunk to a map, as ChunkLog::add_to.
void add_chunk(const Chunk& chunk, BrickMap& map);

}  // namespace flyball
