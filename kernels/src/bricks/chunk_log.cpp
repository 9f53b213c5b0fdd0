// SPDX-License-Identifier: BSD-3-Clause
#include "chunk_log.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace flyball {
namespace {

// One entry: the chunk's key, which of its bricks are known, and those.
struct Entry {
  CellKey chunk{};
  BrickBits known{};
};

bool has(const BrickBits& bits, std::size_t brick) {
  return (bits[brick >> 6U] >> (brick & 63U) & 1U) != 0;
}

/// Log-odds add up, as two series of scans do; only the clamps are applied once more.
std::int8_t together(std::int8_t a, std::int8_t b) {
  if (a == log_odds::unknown || b == log_odds::unknown) {
    return std::max(a, b);
  }
  return static_cast<std::int8_t>(std::clamp(a + b, int{log_odds::least}, int{log_odds::most}));
}

void add_brick(const CellKey& key, const Brick& brick, BrickMap& map) {
  const Chunk& chunk = map.cells().chunk_at(key.above(chunk_level - brick_level));
  Brick sum = chunk.bricks[brick_number(key)];
  std::transform(sum.cells.begin(), sum.cells.end(), brick.cells.begin(), sum.cells.begin(),
                 together);
  map.fill(key, sum);
}

template <class T>
void write_as_bytes(std::ofstream& file, const T& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
bool read_as_bytes(std::ifstream& file, T& value) {
  return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

bool add_entry(std::ifstream& file, BrickMap& map) {
  Entry entry;
  if (!read_as_bytes(file, entry)) {
    return false;
  }
  Brick brick{};
  for (std::size_t number = 0; number < Chunk::brick_count; ++number) {
    if (!has(entry.known, number)) {
      continue;
    }
    if (!read_as_bytes(file, brick)) {
      return false;
    }
    add_brick(brick_in(entry.chunk, number), brick, map);
  }
  return true;
}

}  // namespace

ChunkLog::ChunkLog(std::string path)
    : path_{std::move(path)}, file_{path_, std::ios::binary | std::ios::trunc} {}

ChunkLog::~ChunkLog() {
  file_.close();
  (void)std::remove(path_.c_str());
}

Status ChunkLog::status() const {
  if (!file_) {
    return Error{ErrorCode::failed,
                 "cannot write \"" + path_ +
                     "\", where the map keeps what it forgets; name a map file in a "
                     "folder that can be written to"};
  }
  return Done{};
}

void ChunkLog::append(const Chunk& chunk) {
  write_as_bytes(file_, Entry{chunk.key, chunk.has_known});
  for (std::size_t brick = 0; brick < Chunk::brick_count; ++brick) {
    if (has(chunk.has_known, brick)) {
      write_as_bytes(file_, chunk.bricks[brick]);
    }
  }
  ++chunks_;
}

void ChunkLog::forget_occupied(const Vec3& p_W, double radius_m) {
  doubts_.push_back({p_W, radius_m, chunks_});
}

Status ChunkLog::add_to(BrickMap& map) {
  file_.flush();
  if (auto written = status(); !written) {
    return written;
  }
  std::ifstream file{path_, std::ios::binary};
  auto doubt = doubts_.begin();
  for (std::size_t i = 0; i <= chunks_; ++i) {
    for (; doubt != doubts_.end() && doubt->after == i; ++doubt) {
      map.forget_occupied(doubt->p_W, doubt->radius_m);
    }
    if (i < chunks_ && !add_entry(file, map)) {
      return Error{ErrorCode::failed, "what the map forgot cannot be read from \"" + path_ + "\""};
    }
  }
  return Done{};
}

void add_chunk(const Chunk& chunk, BrickMap& map) {
  for (std::size_t brick = 0; brick < Chunk::brick_count; ++brick) {
    if (has(chunk.has_known, brick)) {
      add_brick(brick_in(chunk.key, brick), chunk.bricks[brick], map);
    }
  }
}

}  // namespace flyball
