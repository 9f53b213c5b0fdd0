// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Space that is known to be free although no camera has seen it.

#include "flyball/runtime/geometry.h"

namespace flyball {

/// Declared to the node `map`, which marks it free where its map is unknown.
struct ClearSpace {
  Vec3 centre_W{Vec3::Zero()};
  Cylinder space{};
};

/// The cylinder over a place on the ground where a vehicle may take off and land, 2.5 m high; see
/// `Site::start_clear_m` for its radius.
[[nodiscard]] ClearSpace clear_over(const Vec3& ground_W, double radius_m);

}  // namespace flyball
