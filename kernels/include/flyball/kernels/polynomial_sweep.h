// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A question to any map: does the body hit something anywhere along a polynomial?

#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/trajectory.h"

namespace flyball {

/// Whether the upright body, its centre on the curve, hits an occupied cube at any time of the
/// piece. No pose is left out: the curve lies in the hull of its Bernstein control points, so a
/// body that is wider and higher by their distance from the chord, swept along the chord, covers
/// it (Farin, Curves and Surfaces for CAGD, section 4; Lutterkort and Peters 2001,
/// doi:10.1007/s002110000181, have closer bounds). Where that one hits something the curve is
/// halved, which brings the distance down by about four.
///
/// @param tolerance_m  What comes so near to the body counts as hit. At least a micrometre is
/// taken.
/// @return             True also where the piece is not finite.
/// @cost               One `segment_hits` for a free curve that is nearly straight; some more near
///                     obstacles. Allocates nothing.
[[nodiscard]] bool sweep_hits(const OccupancyView& map,
                              const PolynomialPiece& piece,
                              const Cylinder& body,
                              double tolerance_m = 0.002);

}  // namespace flyball
