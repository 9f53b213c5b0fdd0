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

/// The cylinder over a place on the ground where a vehicle may take off and land: 1 m in radius,
/// 2.5 m high.
[[nodiscard]] ClearSpace clear_over(const Vec3& ground_W);

}  // namespace flyball
