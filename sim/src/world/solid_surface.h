// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A mesh from a file as a dense grid of cells: solid where its surface is, free elsewhere.

#include "flyball/runtime/result.h"

#include "sensors/scan_grid.h"
#include <array>
#include <string>

namespace flyball {

/// Whether a triangle touches a box: separating axes, Akenine-Moeller 2001.
[[nodiscard]] bool touches(const std::array<Vec3, 3>& triangle, const Aabb& box);

/// COLLADA files say it themselves, whatever is asked for. `file`: y for glTF, whose standard says
/// so; else z, which is what CAD programs write. OBJ files mostly have y.
enum class UpAxis { file, y, z };
/// @param name  `file`, `y` or `z`.
[[nodiscard]] UpAxis up_axis(const std::string& name);

struct MeshReading {
  double cell_m{0.1};
  double metres_per_unit{1.0};
  UpAxis up{UpAxis::file};
  unsigned processor_s{3};  ///< For a small file; more for a large one.
};

/// What Assimp reads: OBJ, STL, PLY, glTF, COLLADA, Blender's and more. Each cell that a triangle
/// touches is occupied, so that a surface is never thinner than it is, and up to a cell thicker.
///
/// @error `not_found`; `invalid_input` when nothing can be read from it (with Assimp's reason),
/// when
///        reading it takes too long or crashes, or when it is larger than 2e8 cells.
[[nodiscard]] Result<ScanGrid> read_mesh(const std::string& path, const MeshReading& reading);

}  // namespace flyball
