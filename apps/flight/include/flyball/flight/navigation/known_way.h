// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A way that was found, flown into from another place than it was found from.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <vector>

namespace flyball {

struct KnownWay {
  std::vector<Vec3> waypoints_W{};
  Cylinder body{};  ///< For which it was found.
};

/// Over the straight line between its ends. @pre The way has a waypoint at least.
[[nodiscard]] double detour_m(const std::vector<Vec3>& way_W);

/// The way's waypoints, with `start_W` for the first one. The second one is left out where the
/// start is past it already and nothing stands before the third. Whether what then is the first
/// edge is free, is not asked.
/// @pre The way has two waypoints at least.
[[nodiscard]] std::vector<Vec3> joined_to(const Vec3& start_W,
                                          const KnownWay& way,
                                          const OccupancyView& map);

}  // namespace flyball
