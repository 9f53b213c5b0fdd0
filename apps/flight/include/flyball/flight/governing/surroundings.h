// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What stands around the vehicle and lies ahead of it, as policies are told.

#include "flyball/flight/mission_topics.h"
#include "flyball/flight/navigation/guidance.h"
#include "flyball/runtime/occupancy.h"

namespace flyball {

// The neighbourhood whose density counts: the delivery camera's range of 7 m less the distance
// flown during one frame, and a band of heights that is just wider than the body. A wider band
// would include cells of the ground, because depth noise at .80 m cells marks all of [0, .80).
inline constexpr double density_radius_m = 6.0;
inline constexpr double density_half_band_m = 0.3;

/// The slowest limit here and at places ahead on the path.
[[nodiscard]] double speed_limit_ahead(const NavigatorState& navigator,
                                       const KnobsInForce& knobs,
                                       const Site& site);

/// From the vehicle to the nearest zone with a lower speed limit than where it is, at most 40 m.
[[nodiscard]] double slower_zone_m(const NavigatorState& navigator,
                                   const KnobsInForce& knobs,
                                   const Site& site);

/// The largest density around places ahead on the path; 0 without a path.
[[nodiscard]] double density_ahead(const NavigatorState& navigator, const OccupancyView& map);

/// From the top of the body up to an obstacle, over the whole body, at most 5 m.
[[nodiscard]] double headroom_m(const Vec3& p_W, const Cylinder& body, const OccupancyView& map);

}  // namespace flyball
