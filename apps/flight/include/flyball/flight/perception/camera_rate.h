// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Fewer frames than the camera takes, for all that looks at them.

#include "flyball/flight/flight_parts.h"

namespace flyball {

/// Where the settings ask for the knob `camera.rate_hz`, adds the node `camera` (and `camera_view`,
/// where there is an RGB-D camera), which passes frames on at that rate and takes no time.
///
/// @return  The parts, with the frames that were passed on in the place of the vehicle's.
[[nodiscard]] FlightParts with_camera_rate(Graph& graph, const FlightParts& parts);

}  // namespace flyball
