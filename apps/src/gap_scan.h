// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How wide the way towards the goal is, as the map has it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

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

}  // namespace flyball
