// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_view
#include "box_words.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr int block_level = 4;
constexpr std::uint64_t all = ~std::uint64_t{0};
using AtLeast = std::array<std::array<std::uint64_t, 5>, 3>;

/// Bits of 4 x 4 x 4 things whose offset along an axis is at least 0, 1, 2, 3, 4. Bit b belongs to
/// the thing at `offset(b, axis)`.
template <class Offset>
constexpr AtLeast at_least(Offset offset) {
  AtLeast words{};
  for (unsigned axis = 0; axis < 3; ++axis) {
    for (unsigned least = 0; least < 5; ++least) {
      for (unsigned bit = 0; bit < 64; ++bit) {
        words[axis][least] |= offset(bit, axis) >= least ? std::uint64_t{1} << bit : 0;
      }
    }
  }
  return words;
}
constexpr AtLeast cells_from =
    at_least([](unsigned bit, unsigned axis) { return bit >> 2 * axis & 3U; });
constexpr AtLeast bricks_from = at_least(
    [](unsigned bit, unsigned axis) { return (bit >> axis & 1U) | (bit >> axis >> 2U & 2U); });

/// Those of four that lie between two keys; `first` is the key of the first of the four.
std::uint64_t between(const std::array<std::uint64_t, 5>& from, int first, int low, int high) {
  const auto offset = [&](int key) { return static_cast<std::size_t>(std::clamp(key, 0, 4)); };
  return from[offset(low - first)] & ~from[offset(high + 1 - first)];
}

/// The bricks of a word of BrickBits with an obstacle in their cell of `level`.
std::uint64_t occupied_bricks(const Chunk& chunk, std::size_t word, int level) {
  const std::uint64_t bricks = chunk.has_occupied[word];
  if (level <= brick_level) {
    return bricks;
  }
  if (level > brick_level + 1) {
    return Chunk::any(chunk.has_occupied, level, 64 * word) ? all : 0;
  }
  std::uint64_t eights = bricks | bricks >> 1U;
  eights |= eights >> 2U;
  eights |= eights >> 4U;
  return (eights & 0x0101010101010101) * 0xff;
}

}  // namespace

bool keys_in(const Lattice& lattice, const Aabb& region, double margin_m, KeyBox& keys) {
  const double cells_per_m = lattice.cells_per_m();
  const auto at = [&](double a, double b) { return packed::keys(packed::Pair{a, b}, cells_per_m); };
  const packed::PairKeys low = at(region.min.x() + margin_m, region.min.y() + margin_m);
  const packed::PairKeys high = at(region.max.x() - margin_m, region.max.y() - margin_m);
  const packed::PairKeys z = at(region.min.z() + margin_m, region.max.z() - margin_m);
  const auto bits = [](std::int64_t key) { return static_cast<std::uint64_t>(key); };
  const std::uint64_t one = bits(low[0]);
  if (((one ^ bits(low[1])) | (one ^ bits(high[0])) | (one ^ bits(high[1])) | (one ^ bits(z[0])) |
       (one ^ bits(z[1])) | (one ^ packed::whole)) > packed::key_bits) {
    return false;
  }
  const auto key = [&](std::int64_t bits_of_it) {
    return static_cast<int>(bits(bits_of_it) & packed::key_bits);
  };
  keys.low = {key(low[0]), key(low[1]), key(z[0])};
  keys.high = {key(high[0]), key(high[1]), key(z[1])};
  return true;
}

BoxBricks::BoxBricks(const KeyBox& keys)
    : keys_{keys},
      first_block_{keys.low[0] >> block_level, keys.low[1] >> block_level,
                   keys.low[2] >> block_level},
      last_block_{keys.high[0] >> block_level, keys.high[1] >> block_level,
                  keys.high[2] >> block_level},
      fits_{(keys.high[0] >> brick_level) - (keys.low[0] >> brick_level) < most_bricks &&
            (keys.high[1] >> brick_level) - (keys.low[1] >> brick_level) < most_bricks &&
            (keys.high[2] >> brick_level) - (keys.low[2] >> brick_level) < most_bricks} {}

std::uint64_t BoxBricks::bricks_in(const CellKey& block) const {
  const auto along = [&](std::size_t axis, int key) {
    return between(bricks_from[axis], 4 * key, keys_.low[axis] >> brick_level,
                   keys_.high[axis] >> brick_level);
  };
  return along(0, block.x) & along(1, block.y) & along(2, block.z);
}

std::uint64_t BoxBricks::cells_of(const CellKey& brick) const {
  const auto along = [&](std::size_t axis, int key) {
    return between(cells_from[axis], 4 * key, keys_.low[axis], keys_.high[axis]);
  };
  return along(0, brick.x) & along(1, brick.y) & along(2, brick.z);
}

BoxWords::BoxWords(const BrickCells& map, int level, const BoxBricks& bricks)
    : level_{level}, bricks_{bricks} {
  const CellKey& first = bricks.first_block();
  const CellKey& last = bricks.last_block();
  for (int z = first.z; z <= last.z; ++z) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        read(map, {x, y, z});
      }
    }
  }
}

void BoxWords::read(const BrickCells& map, const CellKey& block) {
  const Chunk& chunk = map.chunk_at(block.above(chunk_level - block_level));
  const auto word =
      static_cast<std::size_t>((block.x & 1) | (block.y & 1) << 1 | (block.z & 1) << 2);
  const std::uint64_t bricks = bricks_.bricks_in(block);
  Block& kept = blocks_[count_++];
  kept = {&chunk, block, word, occupied_bricks(chunk, word, level_) & bricks,
          chunk.has_unknown[word] & bricks};
  has_occupied_ = has_occupied_ || kept.occupied != 0;
  has_unknown_ = has_unknown_ || kept.unknown != 0;
  has_known_ = has_known_ || (chunk.has_known[word] & bricks) != 0;
}

}  // namespace flyball
