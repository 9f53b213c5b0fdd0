// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A mesh from a file as a dense grid of cells: solid where its surface is, free elsewhere.

#include "sensors/scan_grid.h"
#include <array>

namespace flyball {

/// Whether a triangle touches a box: separating axes, Akenine-Moeller 2001.
[[nodiscard]] bool touches(const std::array<Vec3, 3>& triangle, const Aabb& box);

struct MeshReading {
  double cell_m{0.1};
  double metres_per_unit{1.0};
  bool y_is_up{};  ///< Else z; glTF and OBJ mostly have y, CAD formats z.
};

/// What Assimp reads: OBJ, STL, PLY, glTF, COLLADA, Blender's and more. Each cell that a triangle
/// touches is occupied, so that a surface is never thinner than it is, and up to a cell thicker.
///
/// @error `not_found`; `invalid_input` when nothing can be read from it, or when it is larger than
/// 2e8 cells.
[[nodiscard]] Result<ScanGrid> read_mesh(const std::string& path, const MeshReading& reading);

}  // namespace flyball
