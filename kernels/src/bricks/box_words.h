// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A small box of cells, held against the map 64 bricks at a time: one word says which of them have
/// occupied cells, one which have unknown ones. Only the cells of bricks that have a bit there are
/// looked at. For bodies, which are a few bricks wide, this is faster than walking down the levels.

#include "bits.h"
#include "brick_cells.h"
#include <array>

namespace flyball {

/// The eight cells of each cell of level 1 that has a bit.
[[nodiscard]] inline std::uint64_t whole_eighths(std::uint64_t cells) {
  cells = (cells | cells >> 1U) & 0x5555555555555555;
  cells = (cells | cells >> 4U) & 0x0f0f0f0f0f0f0f0f;
  cells = (cells | cells >> 16U) & 0x0000ffff0000ffff;
  return cells * 0x330033;  // no two of these bits are so near that they would carry
}

/// The cells of a brick that are occupied at a level: a coarser cell is so as a whole.
[[nodiscard]] inline std::uint64_t occupied_at(int level, const Chunk& chunk, std::size_t brick) {
  if (level > 1) {
    return Chunk::any(chunk.has_occupied, level, brick) ? ~std::uint64_t{0} : 0;
  }
  const std::uint64_t cells = chunk.masks[brick].occupied;
  return level == 0 ? cells : whole_eighths(cells);
}

/// Finest cells between two keys on each axis, both included.
struct KeyBox {
  std::array<int, 3> low{};
  std::array<int, 3> high{};

  [[nodiscard]] bool is_empty() const {
    return high[0] < low[0] || high[1] < low[1] || high[2] < low[2];
  }
};

/// Keys of the finest cells of which `region` covers more than `margin_m`.
/// @return  False when the lattice does not have them all.
[[nodiscard]] bool keys_in(const Lattice& lattice,
                           const Aabb& region,
                           double margin_m,
                           KeyBox& keys);

/// The bricks that a box of keys touches, and which of their cells it covers.
class BoxBricks {
 public:
  static constexpr int most_bricks = 4;  ///< Along each axis.

  /// @pre The box is not empty. Only `fits` may be asked when it is too large.
  explicit BoxBricks(const KeyBox& keys);

  [[nodiscard]] bool fits() const { return fits_; }
  /// Of the 4 x 4 x 4 bricks with a key of level 4, those in the box, in Morton order.
  [[nodiscard]] std::uint64_t bricks_in(const CellKey& block) const;
  /// The covered cells of a brick of the box.
  [[nodiscard]] std::uint64_t cells_of(const CellKey& brick) const;
  [[nodiscard]] const CellKey& first_block() const { return first_block_; }
  [[nodiscard]] const CellKey& last_block() const { return last_block_; }

 private:
  KeyBox keys_;
  CellKey first_block_;
  CellKey last_block_;
  bool fits_;
};

/// What the map has of the bricks of a box, at a level.
class BoxWords {
 public:
  /// A block of 4 x 4 x 4 bricks of which the box holds some.
  struct Block {
    const Chunk* chunk{};
    CellKey key{};             ///< At level 4.
    std::size_t word{};        ///< In the chunk's BrickBits.
    std::uint64_t occupied{};  ///< Bricks of the box that have such cells, covered or not.
    std::uint64_t unknown{};
  };

  /// @pre `bricks.fits()`; both outlive this.
  BoxWords(const BrickCells& map, int level, const BoxBricks& bricks);

  [[nodiscard]] bool may_have_occupied() const { return has_occupied_; }
  [[nodiscard]] bool may_have_unknown() const { return has_unknown_; }
  /// Whether nothing at all is known of these bricks.
  [[nodiscard]] bool is_blank() const { return !has_known_ && !has_occupied_; }

  /// Shows each brick with occupied or unknown cells that the box covers: its key, the former, the
  /// latter. Ends when `show` returns true, and says whether it did.
  template <class Show>
  [[nodiscard]] bool any_brick(Show&& show) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Block& block = blocks_[i];
      for (std::uint64_t left = block.occupied | block.unknown; left != 0; left &= left - 1) {
        const std::size_t offset = lowest_bit(left);
        const std::size_t number = 64 * block.word + offset;
        const CellKey brick{4 * block.key.x + brick_offset(offset, 0),
                            4 * block.key.y + brick_offset(offset, 1),
                            4 * block.key.z + brick_offset(offset, 2)};
        const std::uint64_t cells = bricks_.cells_of(brick);
        const std::uint64_t occupied = occupied_at(level_, *block.chunk, number) & cells;
        const std::uint64_t unknown = block.chunk->masks[number].unknown & cells;
        if ((occupied | unknown) != 0 && show(brick, occupied, unknown)) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  void read(const BrickCells& map, const CellKey& block);

  int level_;
  const BoxBricks& bricks_;
  std::array<Block, 8> blocks_;  // not filled here: each body would pay for it
  std::size_t count_{};
  bool has_occupied_{};
  bool has_unknown_{};
  bool has_known_{};
};

}  // namespace flyball
