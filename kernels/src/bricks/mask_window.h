// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A dense window of chunks around a scan, with the two masks of every brick: where whole blocks of
/// cells are freed at a time. (Rays, which mark cell by cell, are faster with bytes: MarkWindow.)

#include "scan_masks.h"
#include <array>
#include <cstdint>
#include <vector>

namespace flyball {

/// Bricks in Morton order, so that a coarser cell's are neighbours.
struct ChunkMasks {
  std::array<std::uint64_t, 512> free{};
  std::array<std::uint64_t, 512> hit{};
  std::array<std::uint64_t, 8> touched{};  ///< A bit for each brick that has a mask.

  void add_free(std::size_t brick, std::uint64_t cells) {
    free[brick] |= cells;
    touched[brick >> 6U] |= std::uint64_t{1} << (brick & 63U);
  }
  void add_hit(std::size_t brick, std::uint64_t cells) {
    hit[brick] |= cells;
    touched[brick >> 6U] |= std::uint64_t{1} << (brick & 63U);
  }
};

class MaskWindow {
 public:
  /// Covers the chunks from `first` to `last`, both included. All masks are gone.
  void span(const CellKey& first, const CellKey& last);
  /// @pre `chunk` lies in the window.
  [[nodiscard]] ChunkMasks& at(const CellKey& chunk);
  [[nodiscard]] bool contains(const CellKey& chunk) const;
  /// Appends the bricks with masks, wipes them, and returns how many cells these are.
  std::size_t collect(std::vector<BrickMasks>& bricks);

 private:
  [[nodiscard]] std::size_t index(const CellKey& chunk) const;

  CellKey first_{};
  CellKey size_{};
  std::vector<ChunkMasks> chunks_{};  ///< Only grows; without masks between two scans.
};

}  // namespace flyball
