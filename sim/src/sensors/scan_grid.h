// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A scanned place as a dense grid of cells, read from OctoMap's binary files (.bt).

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/result.h"

#include <cstddef>
#include <functional>
#include <string>
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

/// @error `not_found`; `invalid_input` when it is no OcTree, is cut off, empty, or larger than 2e8
/// cells.
///
/// Own reader: the library's prints to the terminal, also when all is well.
[[nodiscard]] Result<ScanGrid> read_scan(const std::string& path);

/// The cells that `is_solid` as boxes: runs along x, equal runs joined along y, those along z.
[[nodiscard]] std::vector<Aabb> merged_boxes(
    const ScanGrid& grid, const std::function<bool(const ScanGrid::Index&)>& is_solid);

}  // namespace flyball
