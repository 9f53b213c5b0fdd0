// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a body can get to from a place, through what is known to be free, and how far that is.

#include "planning/state_grid.h"
#include <cstdint>

namespace flyball {

/// A cell in whose centre the body can stand.
struct Place {
  GridCell cell{};
  double path_m{};  ///< From the start, along the cells' edges.
};

class StandingPlaces {
 public:
  /// Floods the grid from the place nearest to `from_W`, at most .6 m or half the diagonal of a
  /// cell away from it.
  ///
  /// @cost In proportion to the grid's cells, times the body's for those at a border of free space.
  StandingPlaces(const StateGrid& grid,
                 const Cylinder& body,
                 const Aabb& bounds_W,
                 const Vec3& from_W);

  [[nodiscard]] const StateGrid& grid() const { return grid_; }
  /// Every second one along each horizontal axis, nearest first: enough to look from. In cells
  /// wider than .3 m every one.
  [[nodiscard]] const std::vector<Place>& thinned() const { return thinned_; }
  /// Cells that the flood looked at.
  [[nodiscard]] double cells() const { return cells_; }
  [[nodiscard]] bool reaches(const GridCell& cell) const {
    return grid_.contains(cell) && steps_[grid_.index(cell)] != far;
  }

 private:
  static constexpr std::uint32_t far = 0xffffffff;

  void block_near_obstacles(const Cylinder& body);
  [[nodiscard]] bool reaches_out(const GridCell& cell) const;
  void block(const GridCell& cell, const std::vector<GridCell>& reach);
  [[nodiscard]] bool is_open(const GridCell& cell, const Aabb& bounds_W) const;
  [[nodiscard]] bool find_start(const Aabb& bounds_W, const Vec3& from_W, GridCell& start) const;
  void flood(const GridCell& start, const Aabb& bounds_W);

  const StateGrid& grid_;
  GridCell reach_{};  ///< Of the body, along each axis.
  std::vector<bool> blocked_{};
  std::vector<std::uint32_t> steps_{};  ///< In cells.
  std::vector<Place> thinned_{};
  double cells_{};
};

}  // namespace flyball
