// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the map and the committed path tell of the surroundings.

#include "flyball/flight/mission_topics.h"
#include "flyball/flight/navigation/guidance.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/occupancy.h"

namespace flyball {

/// The mission's least speed limit, here and 20 m on along the path.
[[nodiscard]] double speed_limit_ahead(const NavigatorState& navigator,
                                       const KnobsInForce& knobs,
                                       const Site& site);

/// Until there is a map, nothing is known to stand anywhere.
void observe_no_map(Observation& seen);

/// Densities, gaps, the nearest obstacle and the headroom.
void observe_map(const NavigatorState& navigator,
                 const OccupancyView& map,
                 const Brief& brief,
                 Observation& seen);

}  // namespace flyball
