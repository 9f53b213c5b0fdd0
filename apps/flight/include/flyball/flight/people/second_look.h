// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From where to look once more at a place where somebody was seen.

#include "flyball/flight/people/person_finding.h"
#include "flyball/kernels/explorer.h"
#include "flyball/runtime/occupancy.h"

#include <optional>

namespace flyball {

/// A view of where somebody may be, from so far beside where they were seen from that it counts as
/// another sighting, at the same height: towards the place if it is far enough, or else left, right
/// or away from it, whichever is free first. Empty where nothing is free.
///
/// @param body      Of the vehicle, with its tube at a crawl.
/// @param bounds_W  That it may fly in.
/// @param doubt     A slow detector says so when the vehicle is past `from_W`.
/// @param apart_m   `SearchSettings::apart_m`.
[[nodiscard]] std::optional<Viewpoint> second_look(const OccupancyView& map,
                                                   const Cylinder& body,
                                                   const Aabb& bounds_W,
                                                   const Doubt& doubt,
                                                   double apart_m);

}  // namespace flyball
