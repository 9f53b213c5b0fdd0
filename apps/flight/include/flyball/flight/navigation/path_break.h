// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a path is broken that was free on an older map, so that only that part is planned anew.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <optional>
#include <vector>

namespace flyball {

/// A path whose middle is blocked.
struct PathBreak {
  std::vector<Vec3> before_W{};  ///< Free, from the start on; at least one place.
  std::vector<Vec3>
      behind_W{};  ///< Free, to the end; at least one place. Empty: nothing is broken.
};

/// The part behind the break begins as near to it as the map allows, not at the next corner,
/// because what has to be planned is then short.
///
/// @param path_W   At least two waypoints.
/// @param queries  How often the map was asked about a segment is added to it.
/// @return         None where the path's end is blocked: it cannot be mended.
[[nodiscard]] std::optional<PathBreak> break_of(const std::vector<Vec3>& path_W,
                                                const OccupancyView& map,
                                                const Cylinder& body,
                                                double& queries);

}  // namespace flyball
