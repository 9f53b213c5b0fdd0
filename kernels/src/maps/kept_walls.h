// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Keeps a map from losing walls that rays only pass beside.
///
/// Stock OctoMap frees a cell when enough rays cross it, though a wall may fill a part of the cell
/// that none of them touches. A vehicle that stands still and looks along a wall, or past the edge
/// of a hole, gets such rays with each frame, and what it stands beside vanishes from its map. So
/// questions go on finding an occupied cell where the tree has lost it, until one scan sees through
/// the cell as a whole. The trees stay as stock makes them.

#include "bricks/bits.h"
#include "bricks/brick_cells.h"
#include "scans/scan_masks.h"
#include "scans/whole_view.h"
#include <vector>

namespace flyball {

class KeptWalls {
 public:
  /// To be called before a scan is written: notes which cells are occupied where it changes the
  /// map, and which of them it sees through.
  ///
  /// @param shown  What questions find now.
  /// @param view   Of the scan. Null where there is no image: then a cell that a ray crosses counts
  ///               as seen through, which is stock's rule.
  void look(const std::vector<BrickMasks>& scan, const BrickCells& shown, const WholeView* view);

  /// To be called after the scan is written: shows again what it must not have freed.
  template <class Store>
  void restore(Store& store) {
    for (const Wall& wall : walls_) {
      const CellMasks& now = store.cells().masks(wall.brick);
      CellMasks next = now;
      for (std::uint64_t left = wall.seen_through & now.occupied; left != 0; left &= left - 1) {
        const auto bit = static_cast<unsigned>(lowest_bit(left));
        // It may have been shown for the sake of an earlier scan only.
        if (!store.is_occupied(cell_of(wall.brick, bit))) {
          next.occupied &= ~(std::uint64_t{1} << bit);
        }
      }
      next.occupied |= wall.occupied & ~wall.seen_through;
      next.unknown &= ~next.occupied;
      if (next.occupied != now.occupied) {
        store.show({wall.brick, next});
      }
    }
    walls_.clear();
  }

 private:
  /// The occupied cells of a brick.
  struct Wall {
    CellKey brick{};
    std::uint64_t occupied{};
    std::uint64_t seen_through{};
  };
  std::vector<Wall> walls_{};  ///< Of the scan that is to be written.
};

}  // namespace flyball
