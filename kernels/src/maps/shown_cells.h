// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a view shows as occupied, as a mapper lists it.

#include "flyball/kernels/mapper.h"

#include <vector>

namespace flyball {

/// @param view  Has `for_each_occupied(show)`, which hands over cubes.
template <class View>
std::vector<OccupiedCell> shown_cells(const View& view) {
  std::vector<OccupiedCell> cells;
  view.for_each_occupied([&cells](const Aabb& cube) {
    cells.push_back({0.5 * (cube.min + cube.max), cube.max.x() - cube.min.x()});
  });
  return cells;
}

}  // namespace flyball
