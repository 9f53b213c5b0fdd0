// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What every front-end makes of a scan: for each brick that the scan touched, which of its 64
/// cells were seen through and which were hit. Free space at a coarser floor is the same thing with
/// whole blocks of bits, so the map and the record know one input only.

#include "bricks/lattice.h"
#include <cstdint>
#include <vector>

namespace flyball {

/// Cell (x, y, z) of a brick, each 0..3, is bit 16 z + 4 y + x.
[[nodiscard]] inline unsigned bit_in_brick(const CellKey& cell) {
  return static_cast<unsigned>((cell.z & 3) << 4 | (cell.y & 3) << 2 | (cell.x & 3));
}

/// The cell of a brick that has this bit.
[[nodiscard]] inline CellKey cell_of(const CellKey& brick, unsigned bit) {
  return {4 * brick.x + static_cast<int>(bit & 3U), 4 * brick.y + static_cast<int>(bit >> 2U & 3U),
          4 * brick.z + static_cast<int>(bit >> 4U)};
}

struct BrickMasks {
  CellKey brick{};  ///< At `brick_level`.
  std::uint64_t free{};
  std::uint64_t hit{};  ///< No cell is in both masks: what was hit is not freed by the same scan.
};

struct ScanMasks {
  /// Each brick once; chunk by chunk (8 x 8 x 8 bricks), in a chunk in Morton order.
  std::vector<BrickMasks> bricks{};
  double rays{};
  double traversals{};  ///< Cells that the rays cross, with repeats. Zero where no ray is walked.
  double blocks{};      ///< Blocks of space held against a depth image. Zero where rays are walked.
  double updates{};     ///< Cells that change: bits set.
};

}  // namespace flyball
