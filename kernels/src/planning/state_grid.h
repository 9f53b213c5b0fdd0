// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A box of the map, copied cell by cell, so that millions of looks at it cost little.

#include "flyball/runtime/grid_walk.h"
#include "flyball/runtime/occupancy.h"

#include <cstddef>
#include <vector>

namespace flyball {

class StateGrid {
 public:
  /// Cells of the map's resolution that cover the box.
  /// @param threads  So many ask the map at once.
  StateGrid(const OccupancyView& map, const Aabb& box_W, int threads = 1);

  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] const GridCell& first() const { return first_; }
  [[nodiscard]] const GridCell& last() const { return last_; }  ///< Inside, too.
  [[nodiscard]] std::size_t size() const { return states_.size(); }

  [[nodiscard]] bool contains(const GridCell& cell) const {
    return cell[0] >= first_[0] && cell[0] <= last_[0] && cell[1] >= first_[1] &&
           cell[1] <= last_[1] && cell[2] >= first_[2] && cell[2] <= last_[2];
  }
  /// @pre `contains(cell)`.
  [[nodiscard]] std::size_t index(const GridCell& cell) const {
    return static_cast<std::size_t>(
        ((cell[2] - first_[2]) * (last_[1] - first_[1] + 1) + cell[1] - first_[1]) *
            (last_[0] - first_[0] + 1) +
        cell[0] - first_[0]);
  }
  [[nodiscard]] GridCell cell_at(std::size_t index) const;
  /// Unknown outside.
  [[nodiscard]] CellState at(const GridCell& cell) const {
    return contains(cell) ? states_[index(cell)] : CellState::unknown;
  }
  [[nodiscard]] GridCell cell_of(const Vec3& p_W) const { return grid_cell_of(p_W, cell_m_); }
  [[nodiscard]] Vec3 centre(const GridCell& cell) const { return centre_of(cell, cell_m_); }

  /// Whether nothing occupied lies on the line from `from_W` to the cell's centre; the cell itself
  /// does not count. Adds the cells that it crossed.
  [[nodiscard]] bool sees(const Vec3& from_W, const GridCell& cell, double& crossed) const;

 private:
  double cell_m_;
  GridCell first_{};
  GridCell last_{};
  std::vector<CellState> states_{};
};

}  // namespace flyball
