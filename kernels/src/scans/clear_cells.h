// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which cells of a coarse map surely hold no wall.
///
/// Rays that pass beside a wall free the cell that contains it, and if none of them ends there, the
/// map never learns of the wall. But what lies behind its surface stays unseen. So a cell is clear
/// only if no ray ever ended in it and all its 26 neighbours are known: a wall that is not thinner
/// than a cell and was seen from one side has an unknown cell beside it. (Neighbours that reach
/// into space that was declared clear count as known: a camera that stands in it does not see them,
/// and they are on its side of the wall.)

#include "flyball/runtime/geometry.h"

#include "bricks/brick_map.h"
#include "scan_masks.h"
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace flyball {

class ClearCells {
 public:
  explicit ClearCells(double cell_m) : cells_{BrickMap::of_states(cell_m)} {}

  /// @param changes  Of one scan, on the lattice of these cells.
  void add(const std::vector<BrickMasks>& changes);
  /// Adds all that a map knows: its occupied cells are the ones that were hit.
  void add(const BrickCells& map);
  /// @param space  Upright, around `centre_W`.
  void declare(const Vec3& centre_W, const Cylinder& space);
  /// The clear cells as free ones; all others are unknown.
  [[nodiscard]] const BrickCells& cells() const { return cells_.cells(); }
  [[nodiscard]] std::shared_ptr<const BrickCells> revision() { return cells_.revision(); }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Known {
    std::uint64_t known{};
    std::uint64_t ever_hit{};
    std::uint64_t declared{};
    std::uint64_t clear{};
  };
  /// Cells around a brick that are known, (x, y, z) from -1 to 4: bit x + 1 of [z + 1][y + 1].
  using Rows = std::array<std::array<unsigned, 6>, 6>;

  void take(const BrickMasks& change);
  void declare(const CellKey& cell);
  void changes_around(const CellKey& brick);
  void update_changed();
  void update(const CellKey& at);
  [[nodiscard]] Rows known_around(const CellKey& at) const;
  [[nodiscard]] static std::uint64_t surrounded(const Rows& known);

  std::unordered_map<std::uint64_t, Known> bricks_{};
  BrickMap cells_;
  std::vector<CellKey> changed_{};    ///< Bricks whose clear cells may be others now.
  std::vector<BrickStates> shown_{};  ///< Those whose clear cells are others.
};

}  // namespace flyball
