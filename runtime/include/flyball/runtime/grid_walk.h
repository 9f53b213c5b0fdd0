// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The cells of a cubic lattice that lie between two points.

#include "flyball/runtime/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace flyball {

/// Cell (i, j, k) is [i c, (i + 1) c) along x, and so on, from W's origin.
using GridCell = std::array<int, 3>;

[[nodiscard]] inline GridCell grid_cell_of(const Vec3& p_W, double cell_m) {
  const auto index = [cell_m](double x_m) { return static_cast<int>(std::floor(x_m / cell_m)); };
  return {index(p_W.x()), index(p_W.y()), index(p_W.z())};
}

[[nodiscard]] inline Vec3 centre_of(const GridCell& cell, double cell_m) {
  return cell_m * (Vec3{static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                        static_cast<double>(cell[2])} +
                   Vec3::Constant(0.5));
}

/// Where the straight line crosses the borders of cells: as shares of the line, by axis.
struct BorderCrossings {
  std::array<double, 3> next{};   ///< The next border; infinite where none is left.
  std::array<double, 3> delta{};  ///< From one border to the one after it.
  std::array<int, 3> left{};      ///< How many are still to be crossed.
};

/// @pre As `walk_cells`.
[[nodiscard]] inline BorderCrossings border_crossings(const Vec3& from_W,
                                                      const Vec3& to_W,
                                                      double cell_m) {
  const GridCell cell = grid_cell_of(from_W, cell_m);
  const GridCell end = grid_cell_of(to_W, cell_m);
  const Vec3 along = to_W - from_W;
  BorderCrossings at;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    at.left[i] = std::abs(end[i] - cell[i]);
    at.delta[i] = cell_m / std::abs(along[axis]);
    const double border_m = (cell[i] + (end[i] > cell[i] ? 1 : 0)) * cell_m;
    at.next[i] = at.left[i] > 0 ? (border_m - from_W[axis]) / along[axis]
                                : std::numeric_limits<double>::infinity();
  }
  return at;
}

/// The axis of the least of three numbers; of equal ones the last.
[[nodiscard]] inline std::size_t least_of(const std::array<double, 3>& of) {
  return of[0] < of[1] ? (of[0] < of[2] ? 0U : 2U) : (of[1] < of[2] ? 1U : 2U);
}

/// Visits the cells that the straight line crosses, in order, those of both ends included, until
/// `visit(cell)` returns false. Amanatides & Woo 1987; the number of steps along each axis is known
/// beforehand, so rounding never carries the walk past its end.
///
/// @return  Whether the end was reached.
/// @pre     The points are finite and less than 2^30 cells from the origin.
template <class Visit>
bool walk_cells(const Vec3& from_W, const Vec3& to_W, double cell_m, Visit&& visit) {
  constexpr double never = std::numeric_limits<double>::infinity();
  GridCell cell = grid_cell_of(from_W, cell_m);
  const GridCell end = grid_cell_of(to_W, cell_m);
  auto [next, delta, left] = border_crossings(from_W, to_W, cell_m);
  while (true) {
    if (!visit(static_cast<const GridCell&>(cell))) {
      return false;
    }
    const std::size_t i = least_of(next);
    if (left[i] == 0) {
      return true;
    }
    cell[i] += end[i] > cell[i] ? 1 : -1;
    next[i] = --left[i] > 0 ? next[i] + delta[i] : never;
  }
}

}  // namespace flyball
