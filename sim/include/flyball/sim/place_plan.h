// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The plan of a scanned place or a mesh at a height, before a start has been chosen in it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace flyball {

/// How a place is looked at: as worlds `octomap_file` and `mesh_file` take it.
struct PlaceView {
  double ground_z_m{};
  double height_m{1.2};  ///< Above the ground; what a flight there may touch is 0.3 below to 0.5
                         ///< above.
  double cell_m{0.1};    ///< Of a mesh's cells; a map has its own.
  double metres_per_unit{1.0};
  std::string up{"file"};  ///< Of a mesh: `file`, `y` or `z`.
};

/// Cells from above: occupied where anything in the band is, free where the rest is known to be.
struct PlacePlan {
  Aabb extent_W{};
  double cell_m{};
  int columns{};
  int rows{};
  std::vector<CellState> cells{};  ///< Row by row, from the least x and y on.

  [[nodiscard]] CellState at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  }
  [[nodiscard]] double x_m(int column) const {  ///< Of its middle.
    return extent_W.min.x() + (column + 0.5) * cell_m;
  }
  [[nodiscard]] double y_m(int row) const { return extent_W.min.y() + (row + 0.5) * cell_m; }
};

/// @param file  OctoMap's `.bt` or `.ot`, or a mesh; a bare name is one of the current folder, or
///              else an example of OctoMap's.
/// @error `not_found`, `invalid_input` as the worlds have them; `invalid_input` when nothing of the
///        place is as high as the band.
[[nodiscard]] Result<PlacePlan> plan_of_place(const std::string& file, const PlaceView& view);

}  // namespace flyball
