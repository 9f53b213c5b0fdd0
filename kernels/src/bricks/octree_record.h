// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The map of record: the masks of a scan, written into an OctoMap tree as stock insertion would
/// have written their cells, byte for byte, in one descent.
///
/// Two things make it fast. Inner nodes are refreshed once for a scan and not once for a cell. And
/// a node whose cube changes as a whole, and which has no children, changes as one: OctoMap would
/// expand it, change eight equal leaves and prune them again. So free space at a coarser floor
/// costs a node and not its cells, and loses nothing, because (1) hits go in at full depth, (2) a
/// block with a hit in it is not freed as a whole, (3) a free block over refined space reaches
/// every leaf in it, (4) no coarse block is written through the cell at its centre.

#include "brick.h"
#include "maps/octomap_tree.h"
#include "scans/scan_masks.h"
#include <vector>

namespace flyball {

class OctreeRecord {
 public:
  /// @pre    `tree` has the cells of the masks' lattice.
  /// @return The bricks in which a cell has another state than before: few, because most scans
  ///         confirm what is known. Valid until the next call.
  const std::vector<BrickStates>& write(const std::vector<BrickMasks>& changes,
                                        octomap::OcTree& tree);

 private:
  struct Item {
    std::uint64_t code;  ///< Morton code of the brick: three bits for each tree level.
    std::uint64_t free;
    std::uint64_t hit;
  };
  void sort(const std::vector<BrickMasks>& changes);
  static void write_first_cell(Item& item, octomap::OcTree& tree);

  struct Run {
    std::uint64_t code;  ///< Of a chunk.
    std::size_t first;
    std::size_t last;
  };
  std::vector<Run> runs_{};
  std::vector<Item> items_{};                 ///< In Morton order.
  std::vector<std::uint32_t> wholly_free_{};  ///< Of the items before this one, how many.
  std::vector<BrickStates> changed_{};
};

}  // namespace flyball
