// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A scanned place as a dense grid of cells.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace flyball {

/// What a grid may have: 200 MB; a whole storey has 4e6.
inline constexpr double most_grid_cells = 2e8;

/// Cells of the finest size over the extent of what the file knows.
class ScanGrid {
 public:
  using Index = Eigen::Vector3i;

  /// @pre `resolution_m > 0`, `low <= high` (both inside the grid).
  ScanGrid(double resolution_m, const Index& low, const Index& high);

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  [[nodiscard]] const Index& low() const { return low_; }
  [[nodiscard]] const Index& high() const { return high_; }
  [[nodiscard]] Aabb extent_W() const;
  /// Cell (i, j, k) is [i r, (i + 1) r) x ...; unknown outside the grid.
  [[nodiscard]] CellState state(const Index& cell) const;
  /// @pre Inside the grid.
  void set(const Index& cell, CellState state) { states_[offset(cell)] = state; }

 private:
  [[nodiscard]] bool contains(const Index& cell) const;
  [[nodiscard]] std::size_t offset(const Index& cell) const;

  double resolution_m_;
  Index low_;
  Index high_;
  std::vector<CellState> states_;
};

/// Visits all cells of [low, high]: x runs fastest, then y, then z.
template <class Visit>
void for_each_cell(const ScanGrid::Index& low, const ScanGrid::Index& high, const Visit& visit) {
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        visit(ScanGrid::Index{x, y, z});
      }
    }
  }
}

/// The cells that `is_solid` as boxes: runs along x, equal runs joined along y, those along z.
[[nodiscard]] std::vector<Aabb> merged_boxes(
    const ScanGrid& grid, const std::function<bool(const ScanGrid::Index&)>& is_solid);

}  // namespace flyball
