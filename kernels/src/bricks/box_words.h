// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A small box of cells, read brick by brick: one word of occupied and one of unknown cells each.
/// For bodies, which are a few bricks wide, this is faster than walking down the levels.

#include "bits.h"
#include "brick_map.h"
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

class BoxWords {
 public:
  static constexpr int most_bricks = 4;  ///< Along each axis.
  static constexpr int most_cells = 4 * most_bricks;

  /// Reads the finest cells of which `region` covers more than `margin_m`.
  BoxWords(const BrickMap& map, int level, const Aabb& region, double margin_m);

  /// False when the box is too large, or not all in the lattice: then nothing was read.
  [[nodiscard]] bool fits() const { return fits_; }
  [[nodiscard]] bool has_occupied() const { return has_occupied_; }
  [[nodiscard]] bool has_unknown() const { return has_unknown_; }

  /// Whether any such cell is in a column for which `is(x, y)`: finest cells from the first brick.
  template <class Is>
  [[nodiscard]] bool any_occupied(Is&& is) const {
    return has_occupied_ && any_column(occupied_, is);
  }
  template <class Is>
  [[nodiscard]] bool any_unknown(Is&& is) const {
    return has_unknown_ && any_column(unknown_, is);
  }
  /// The cells of the box's bricks along x and y, also of those parts that it does not cover.
  [[nodiscard]] CellKey first_cell() const { return {4 * first_.x, 4 * first_.y, 4 * first_.z}; }
  [[nodiscard]] int cells_along_x() const { return 4 * size_.x; }
  [[nodiscard]] int cells_along_y() const { return 4 * size_.y; }

 private:
  using Words = std::array<std::uint64_t, most_bricks * most_bricks * most_bricks>;
  using AxisCells = std::array<std::uint64_t, most_bricks>;

  void read(const BrickMap& map, int level, const std::array<AxisCells, 3>& cells);

  template <class Is>
  [[nodiscard]] bool any_column(const Words& words, Is&& is) const {
    const int count = size_.x * size_.y * size_.z;
    // From the middle, where columns are most likely in question.
    for (int i = 0, at = count / 2; i < count; ++i, at = at + 1 < count ? at + 1 : 0) {
      const int x = 4 * (at % size_.x);
      const int y = 4 * (at / size_.x % size_.y);
      for (std::uint64_t left = words[static_cast<std::size_t>(at)]; left != 0; left &= left - 1) {
        const auto bit = static_cast<int>(lowest_bit(left));
        if (is(x + (bit & 3), y + (bit >> 2 & 3))) {
          return true;
        }
      }
    }
    return false;
  }

  bool fits_{};
  bool has_occupied_{};
  bool has_unknown_{};
  CellKey first_{};  ///< Brick.
  CellKey size_{};   ///< In bricks.
  Words occupied_;   ///< Brick by brick, x fastest.
  Words unknown_;
};

}  // namespace flyball
