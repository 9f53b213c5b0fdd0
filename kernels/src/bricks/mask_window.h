// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A dense window of chunks around a scan, with the two masks of every brick: where whole blocks of
/// cells are freed at a time. (Rays, which mark cell by cell, are faster with bytes: MarkWindow.)
///
/// A brick's place is its chunk's number in the window, times 512, plus its number in the chunk, so
/// the bricks of a coarser cell are neighbours.

#include "scans/inner_loops.h"
#include "scans/scan_masks.h"
#include <cstdint>
#include <vector>

namespace flyball {

class MaskWindow {
 public:
  /// Covers the chunks from `first` to `last`, both included. All masks are gone.
  /// @pre At most 65535 chunks.
  void span(const CellKey& first, const CellKey& last);
  [[nodiscard]] WindowChunks chunks() const;
  /// Of a chunk's first brick. @pre `chunk` lies in the window.
  [[nodiscard]] std::size_t place(const CellKey& chunk) const;
  /// Of the brick that a cell is in. @pre Its chunk lies in the window.
  [[nodiscard]] std::size_t place_of_cell(const CellKey& cell) const {
    return place(cell.above(chunk_level)) + brick_number(cell.above(brick_level));
  }

  [[nodiscard]] std::uint64_t hits(std::size_t place) const { return masks_[place].hit; }
  [[nodiscard]] std::uint64_t marks(std::size_t place) const {
    return masks_[place].free | masks_[place].hit;
  }
  void add_free(std::size_t place, std::uint64_t cells) {
    masks_[place].free |= cells;
    touch(place);
  }
  void add_hit(std::size_t place, std::uint64_t cells) {
    masks_[place].hit |= cells;
    touch(place);
  }
  /// Frees all cells of so many bricks: 1, 8, 64 or 512, from a place that is a multiple of it.
  void free_block(std::size_t place, std::size_t bricks);
  /// Appends the bricks with masks, wipes them, and returns how many cells these are.
  std::size_t collect(std::vector<BrickMasks>& bricks);

 private:
  struct Masks {
    std::uint64_t free{};
    std::uint64_t hit{};
  };
  void touch(std::size_t place) { touched_[place >> 6U] |= std::uint64_t{1} << (place & 63U); }
  std::size_t collect_chunk(const CellKey& chunk, std::vector<BrickMasks>& bricks);

  CellKey first_{};
  CellKey size_{};
  std::vector<Masks> masks_{};            ///< Only grows; all zero between two scans.
  std::vector<std::uint64_t> touched_{};  ///< A bit for each brick that has a mask.
};

}  // namespace flyball
