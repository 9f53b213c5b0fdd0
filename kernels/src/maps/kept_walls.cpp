// SPDX-License-Identifier: BSD-3-Clause
#include "maps/kept_walls.h"

namespace flyball {

void KeptWalls::look(const std::vector<BrickMasks>& scan,
                     const BrickCells& shown,
                     const WholeView* view) {
  walls_.clear();
  for (const BrickMasks& change : scan) {
    const std::uint64_t occupied = shown.masks(change.brick).occupied;
    if (occupied == 0) {
      continue;
    }
    std::uint64_t seen_through = occupied & change.free;
    for (std::uint64_t left = view != nullptr ? seen_through : 0; left != 0; left &= left - 1) {
      const auto bit = static_cast<unsigned>(lowest_bit(left));
      if (!view->sees_through(shown.lattice().cube(cell_of(change.brick, bit), 0))) {
        seen_through &= ~(std::uint64_t{1} << bit);
      }
    }
    walls_.push_back({change.brick, occupied, seen_through});
  }
}

}  // namespace flyball
