// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How wide the passages between the vehicle and its goal are, according to the map.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/trajectory.h"

namespace flyball {

/// The scan lays lines across the direction of the goal, a metre apart, and finds the widest
/// opening on each of them.
struct GapsAhead {
  double narrowest_m{};     ///< The smallest of the widest openings.
  double narrowest_at_m{};  ///< How far ahead that is; the scan's reach when nothing stands there.
  double mean_m{};          ///< Mean of the widest openings.
};

/// The limits of the scan.
struct GapScan {
  double reach_m{24.0};     ///< Ahead: there a camera of 90 degrees sees as far to both sides.
  double aside_m{12.0};     ///< To each side.
  double half_band_m{0.3};  ///< Half the height of the band in which obstacles count.
  Aabb bounds_W{};  ///< The vehicle may not leave these bounds, so no opening lies outside them.
};

/// An opening reaches from obstacle to obstacle and is at most `2 aside_m` wide. Unknown space
/// counts as open. Widths above one metre are exact to a quarter of a metre.
/// @param towards_W  Must differ from `from_W`; its height does not count.
[[nodiscard]] GapsAhead gaps_ahead(const OccupancyView& map,
                                   const Vec3& from_W,
                                   const Vec3& towards_W,
                                   const GapScan& scan);

/// A place on a path, and how wide the passage is there.
struct PathWidth {
  double width_m{};  ///< From side to side.
  double at_m{};     ///< Arc length from the beginning of the span.
};

/// The narrowest place of a path. The width is measured horizontally and perpendicular to the path,
/// up to 3 m to each side; a path without obstacles within 3 m has no narrow place. A path beside a
/// single obstacle is not narrow: in larger cells, which would block it, another one leads by.
/// Unlike `gaps_ahead` this measures the gap that the path really passes, and ignores other
/// openings that may only seem open because they have not been observed yet.
/// @pre The path is not empty.
[[nodiscard]] PathWidth narrowest_on(const OccupancyView& map,
                                     const PathSpan& span,
                                     double half_band_m);

}  // namespace flyball
