// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A path that was planned from one place and is then joined from another one.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <vector>

namespace flyball {

struct KnownPath {
  std::vector<Vec3> waypoints_W{};
  Cylinder body{};  ///< The body, with its tube, that the path was planned for.
};

/// How much longer the path is than the straight line between its ends. @pre The path has at least
/// one waypoint.
[[nodiscard]] double detour_m(const std::vector<Vec3>& path_W);
/// Chosen: a path longer than the straight line by this is worth another search.
constexpr double least_detour_m = 3.0;

/// The waypoints of `path`, with `start_W` in place of the first one. The second waypoint is left
/// out when the start has already passed it and the line to the third is free. The caller must
/// still check that the first edge of the result is free.
/// @pre The path has at least two waypoints.
[[nodiscard]] std::vector<Vec3> joined_to(const Vec3& start_W,
                                          const KnownPath& path,
                                          const OccupancyView& map);
/// Whether it begins backwards for a vehicle that comes in this direction. @pre As above.
[[nodiscard]] bool turns_back(const std::vector<Vec3>& path_W, const Vec3& direction_W);

}  // namespace flyball
