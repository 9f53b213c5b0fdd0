// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How wide the way towards the goal is, as the map has it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/trajectory.h"

namespace flyball {

/// Lines across the way, a metre apart; each has a widest opening.
struct GapsAhead {
  double narrowest_m{};     ///< The least of the widest openings.
  double narrowest_at_m{};  ///< How far ahead that is; the scan's reach when nothing stands there.
  double mean_m{};          ///< Of the widest openings.
};

/// What limits the scan.
struct GapScan {
  double reach_m{24.0};  ///< Ahead: a camera of 90 degrees sees as much to both sides.
  double aside_m{12.0};  ///< To each side.
  double half_band_m{0.3};
  Aabb bounds_W{};  ///< The vehicle may not leave it: there is no opening outside.
};

/// An opening reaches from obstacle to obstacle, `2 aside_m` at most; what is not known counts as
/// open. Widths are exact to a quarter of a metre where they exceed one metre.
/// @param towards_W  Another place than `from_W`; the height does not count.
[[nodiscard]] GapsAhead gaps_ahead(const OccupancyView& map,
                                   const Vec3& from_W,
                                   const Vec3& towards_W,
                                   const GapScan& scan);

/// A place on a path and how wide the way is there.
struct PathWidth {
  double width_m{};  ///< Twice the distance to the nearer side.
  double at_m{};     ///< Along the path, from the beginning of the span.
};

/// The narrowest place of a path: level and square to it, as wide as an obstacle on the nearer side
/// leaves it; at most 3 m to each side, and then no place of it is narrow. Unlike openings towards
/// the goal it means the gap that the path goes through, whatever else seems open because nobody
/// has looked there yet.
/// @pre The path is not empty.
[[nodiscard]] PathWidth narrowest_on(const OccupancyView& map,
                                     const PathSpan& span,
                                     double half_band_m);

}  // namespace flyball
