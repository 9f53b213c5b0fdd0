// SPDX-License-Identifier: BSD-3-Clause
#include "planning/state_grid.h"

#include "planning/side_by_side.h"
#include <array>

namespace flyball {

StateGrid::StateGrid(const OccupancyView& map, const Aabb& box_W, int threads)
    : cell_m_{map.resolution_m()} {
  first_ = cell_of(box_W.min);
  // A box that ends on a border does not reach into the next cell.
  last_ = cell_of(box_W.max - Vec3::Constant(1e-6));
  std::array<std::size_t, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) {
    last_[i] = std::max(last_[i], first_[i]);
    counts[i] = static_cast<std::size_t>(last_[i] - first_[i]) + 1;
  }
  const std::size_t layer = counts[0] * counts[1];
  states_.resize(layer * counts[2]);
  for_each_index(counts[2], threads, [&](std::size_t z) {
    for (std::size_t i = z * layer; i < (z + 1) * layer; ++i) {
      states_[i] = map.state(centre(cell_at(i)));
    }
  });
}

GridCell StateGrid::cell_at(std::size_t index) const {
  const auto wide = static_cast<std::size_t>(last_[0] - first_[0]) + 1;
  const auto deep = static_cast<std::size_t>(last_[1] - first_[1]) + 1;
  return {first_[0] + static_cast<int>(index % wide),
          first_[1] + static_cast<int>(index / wide % deep),
          first_[2] + static_cast<int>(index / (wide * deep))};
}

bool StateGrid::sees(const Vec3& from_W, const GridCell& cell, double& crossed) const {
  return walk_cells(from_W, centre(cell), cell_m_, [&](const GridCell& on_ray) {
    crossed += 1.0;
    return on_ray == cell || at(on_ray) != CellState::occupied;
  });
}

}  // namespace flyball
