// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Masks of a scan, taken apart into single cells.

#include "scans/scan_masks.h"
#include <map>
#include <tuple>

#include <gtest/gtest.h>

namespace flyball::kit {

using Cells = std::map<std::tuple<int, int, int>, bool>;  ///< Whether it was hit.

inline Cells cells_of(const ScanMasks& masks) {
  Cells cells;
  for (const BrickMasks& brick : masks.bricks) {
    EXPECT_EQ(brick.free & brick.hit, 0U);
    for (unsigned bit = 0; bit < 64; ++bit) {
      if (((brick.free | brick.hit) >> bit & 1U) != 0) {
        const auto at = [&](int key, unsigned shift) {
          return 4 * key + static_cast<int>(bit >> shift & 3U);
        };
        cells[{at(brick.brick.x, 0), at(brick.brick.y, 2), at(brick.brick.z, 4)}] =
            (brick.hit >> bit & 1U) != 0;
      }
    }
  }
  return cells;
}

}  // namespace flyball::kit
