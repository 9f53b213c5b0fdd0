// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From where to look once more at a place where somebody was seen.

#include "flyball/kernels/explorer.h"
#include "flyball/runtime/occupancy.h"

namespace flyball {

/// A view of `place_W` from .75 m beside `from_W`, at the same height: towards the place if it is
/// far enough, or else left, right or away from it, whichever is free first. Where nothing is free,
/// it is from `from_W` itself.
///
/// @param from_W    Where somebody was seen from. A slow detector says so when the vehicle is past.
/// @param body      Of the vehicle, with its tube at a crawl.
/// @param bounds_W  That it may fly in.
[[nodiscard]] Viewpoint second_look(const OccupancyView& map,
                                    const Cylinder& body,
                                    const Aabb& bounds_W,
                                    const Vec3& from_W,
                                    const Vec3& place_W);

}  // namespace flyball
