// SPDX-License-Identifier: BSD-3-Clause
#include "planning/standing_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr std::array<GridCell, 6> neighbours{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
// Chosen: the search begins in a cell up to this far from the start, which may touch unknown cells.
constexpr double usually_off_m = 0.6;
// Chosen: of cells up to this wide every second one is enough to look from.
constexpr double thinned_cell_m = 0.3;

/// In wide cells the centre of the very cell that the start lies in can be farther away.
double most_off_m(double cell_m) {
  const double half_diagonal_m = 0.5 * std::sqrt(3.0) * cell_m;
  return std::max(usually_off_m, half_diagonal_m + 1e-6);
}

GridCell sum(const GridCell& a, const GridCell& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// Cells that a body in the middle of one overlaps.
std::vector<GridCell> reach_of(const Cylinder& body, double cell_m) {
  const auto gap_m = [cell_m](int i) { return std::max(0.0, (std::abs(i) - 0.5) * cell_m); };
  const int across = static_cast<int>(std::ceil(body.radius_m / cell_m)) + 1;
  const int up = static_cast<int>(std::ceil(body.half_height_m / cell_m)) + 1;
  std::vector<GridCell> reach;
  const auto add_column = [&](int x, int y) {
    for (int z = -up; z <= up; ++z) {
      if (gap_m(z) < body.half_height_m) {
        reach.push_back({x, y, z});
      }
    }
  };
  for (int x = -across; x <= across; ++x) {
    for (int y = -across; y <= across; ++y) {
      if (std::hypot(gap_m(x), gap_m(y)) < body.radius_m) {
        add_column(x, y);
      }
    }
  }
  return reach;
}

}  // namespace

StandingPlaces::StandingPlaces(const StateGrid& grid,
                               const Cylinder& body,
                               const Aabb& bounds_W,
                               const Vec3& from_W)
    : grid_{grid}, blocked_(grid.size(), false), steps_(grid.size(), far) {
  block_near_obstacles(body);
  GridCell start{};
  if (find_start(bounds_W, from_W, start)) {
    flood(start, bounds_W);
  }
}

// What lies outside the grid is not known: where the body would reach out of it is no place.
bool StandingPlaces::reaches_out(const GridCell& cell) const {
  const GridCell low{cell[0] - reach_[0], cell[1] - reach_[1], cell[2] - reach_[2]};
  return !grid_.contains(low) || !grid_.contains(sum(cell, reach_));
}

void StandingPlaces::block_near_obstacles(const Cylinder& body) {
  const std::vector<GridCell> reach = reach_of(body, grid_.cell_m());
  for (const GridCell& step : reach) {
    for (std::size_t i = 0; i < 3; ++i) {
      reach_[i] = std::max(reach_[i], step[i]);
    }
  }
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const GridCell cell = grid_.cell_at(i);
    if (grid_.at(cell) == CellState::free) {
      continue;
    }
    blocked_[i] = true;
    // Where all neighbours are no place either, they block what this cell would.
    const bool is_border = std::any_of(
        neighbours.begin(), neighbours.end(),
        [&](const GridCell& step) { return grid_.at(sum(cell, step)) == CellState::free; });
    if (is_border) {
      block(cell, reach);
    }
  }
}

void StandingPlaces::block(const GridCell& cell, const std::vector<GridCell>& reach) {
  for (const GridCell& step : reach) {
    const GridCell near = sum(cell, step);
    if (grid_.contains(near)) {
      blocked_[grid_.index(near)] = true;
    }
  }
}

bool StandingPlaces::is_open(const GridCell& cell, const Aabb& bounds_W) const {
  return grid_.contains(cell) && !blocked_[grid_.index(cell)] && !reaches_out(cell) &&
         bounds_W.contains(grid_.centre(cell));
}

bool StandingPlaces::find_start(const Aabb& bounds_W, const Vec3& from_W, GridCell& start) const {
  const GridCell middle = grid_.cell_of(from_W);
  const double limit_m = most_off_m(grid_.cell_m());
  const int reach = static_cast<int>(std::ceil(limit_m / grid_.cell_m()));
  double best_m = limit_m;
  for (int i = 0; i < (2 * reach + 1) * (2 * reach + 1) * (2 * reach + 1); ++i) {
    const int wide = 2 * reach + 1;
    const GridCell cell =
        sum(middle, {i % wide - reach, i / wide % wide - reach, i / (wide * wide) - reach});
    const double off_m = (grid_.centre(cell) - from_W).norm();
    if (off_m < best_m && is_open(cell, bounds_W)) {
      best_m = off_m;
      start = cell;
    }
  }
  return best_m < limit_m;
}

// The search is breadth first, so the queue itself is sorted by length of path.
void StandingPlaces::flood(const GridCell& start, const Aabb& bounds_W) {
  // One row of wide cells may be all there is of a corridor, so none of them is left out.
  const bool is_thinned = grid_.cell_m() <= thinned_cell_m + 1e-9;
  std::vector<GridCell> queue{start};
  steps_[grid_.index(start)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const GridCell cell = queue[i];
    const std::uint32_t steps = steps_[grid_.index(cell)];
    if (!is_thinned || (cell[0] % 2 == 0 && cell[1] % 2 == 0)) {
      thinned_.push_back({cell, steps * grid_.cell_m()});
    }
    for (const GridCell& step : neighbours) {
      const GridCell next = sum(cell, step);
      cells_ += 1.0;
      if (is_open(next, bounds_W) && steps_[grid_.index(next)] == far) {
        steps_[grid_.index(next)] = steps + 1;
        queue.push_back(next);
      }
    }
  }
}

}  // namespace flyball
