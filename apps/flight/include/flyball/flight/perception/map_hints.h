// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the node `map` is told of space beside the camera's frames.

#include "flyball/runtime/geometry.h"

#include <variant>

namespace flyball {

/// Space that is known to be free although no camera has seen it: it becomes free where the map is
/// unknown.
struct ClearSpace {
  Vec3 centre_W{Vec3::Zero()};
  Cylinder space{};
};

/// A place around which obstacles in the map may be noise: see `Mapper::doubt_obstacles`.
struct DoubtedPlace {
  Vec3 centre_W{Vec3::Zero()};
  double radius_m{};
};

using MapHint = std::variant<ClearSpace, DoubtedPlace>;

/// The cylinder over a place on the ground where a vehicle may take off and land: see
/// `Site::start_clear_m` and `Site::clear_height_m`.
[[nodiscard]] ClearSpace clear_over(const Vec3& ground_W, double radius_m, double height_m);

}  // namespace flyball
