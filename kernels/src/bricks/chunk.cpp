// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_map
#include "chunk.h"

#include "bits.h"

namespace flyball {
namespace {

/// Places of bricks (see packed::brick_place) by their numbers.
constexpr std::array<std::uint16_t, Chunk::brick_count> places_of_numbers() {
  std::array<std::uint16_t, Chunk::brick_count> places{};
  for (std::size_t place = 0; place < places.size(); ++place) {
    places[packed::brick_number_at[place]] = static_cast<std::uint16_t>(place);
  }
  return places;
}
constexpr std::array<std::uint16_t, Chunk::brick_count> place_of = places_of_numbers();

/// A chunk of unknown cells, whose tag has to be none in particular, with its log-odds. It stays
/// where it is made.
struct UnknownChunk {
  UnknownChunk() : chunk{CellKey{-1, -1, -1}, &log_odds} {
    clear(log_odds);
    chunk.tag_bits = 0;
  }
  UnknownChunk(const UnknownChunk&) = delete;
  UnknownChunk& operator=(const UnknownChunk&) = delete;
  ~UnknownChunk() = default;

  Chunk::Bricks log_odds{};
  Chunk chunk;
};

}  // namespace

Chunk::Chunk(const CellKey& at, Bricks* log_odds)
    : bricks{log_odds != nullptr ? log_odds->data() : nullptr} {
  set_key(at);
  codes.fill(brick_code::all_unknown);
  has_unknown.fill(~std::uint64_t{0});
}

void Chunk::set_key(const CellKey& at) {
  key = at;
  tag = packed::chunk(at);
  tag_bits = ~std::uint64_t{0};
}

void Chunk::set_masks(std::size_t brick, const CellMasks& cells) {
  masks[brick] = cells;
  const std::uint64_t bit = std::uint64_t{1} << (brick & 63U);
  const auto set = [&](BrickBits& bits, bool is) {
    std::uint64_t& word = bits[brick >> 6U];
    word = is ? word | bit : word & ~bit;
  };
  set(has_unknown, cells.unknown != 0);
  set(has_known, ~cells.unknown != 0);
  const unsigned unknown = cells.unknown == 0    ? brick_code::none_unknown
                           : ~cells.unknown == 0 ? brick_code::all_unknown
                                                 : brick_code::some_unknown;
  std::uint8_t& code = codes[place_of[brick]];
  code = static_cast<std::uint8_t>((code & ~3U) | unknown);
  if ((cells.occupied != 0) != ((has_occupied[brick >> 6U] & bit) != 0)) {
    flip_occupied(brick);
  }
}

void Chunk::forget_occupied() {
  for (std::size_t brick = 0; brick < brick_count; ++brick) {
    const CellMasks cells = masks[brick];
    for (std::uint64_t left = cells.occupied; left != 0; left &= left - 1) {
      bricks[brick].cells[static_cast<std::size_t>(lowest_bit(left))] = log_odds::unknown;
    }
    if (cells.occupied != 0) {
      set_masks(brick, {0, cells.unknown | cells.occupied});
    }
  }
}

/// Seldom: in the codes of all bricks of its coarser blocks, as far as these change.
void Chunk::flip_occupied(std::size_t brick) {
  const auto any_at = [&](int level) { return any(has_occupied, level, brick); };
  const std::array<bool, 4> before{any_at(2), any_at(3), any_at(4), any_at(5)};
  has_occupied[brick >> 6U] ^= std::uint64_t{1} << (brick & 63U);
  for (int level = brick_level; level <= chunk_level; ++level) {
    if (any_at(level) == before[static_cast<std::size_t>(level - brick_level)]) {
      return;  // nor do the coarser ones
    }
    const std::size_t width = std::size_t{1} << 3 * static_cast<unsigned>(level - brick_level);
    const std::size_t first = brick & ~(width - 1);
    for (std::size_t i = first; i < first + width; ++i) {
      std::uint8_t& code = codes[place_of[i]];
      code = static_cast<std::uint8_t>(code ^ brick_code::occupied(level));
    }
  }
}

void clear(Chunk::Bricks& log_odds) {
  for (Brick& brick : log_odds) {
    brick.cells.fill(log_odds::unknown);
  }
}

const Chunk& unknown_chunk() {
  static const UnknownChunk nothing;
  return nothing.chunk;
}

}  // namespace flyball
