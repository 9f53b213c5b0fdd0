// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The plan of a place as a picture from which a start can be read.

#include "flyball/runtime/colour_image.h"
#include "flyball/sim/place_plan.h"

#include <vector>

namespace flyball {

/// Which cells of the plan have room for a vehicle whose centre is above their middle: worlds
/// refuse a start without it.
[[nodiscard]] std::vector<bool> cells_with_room(const PlacePlan& plan);

/// Dark: solid; green: free, with room for a vehicle; white: free; grey: unknown. Lines and numbers
/// are metres, x to the right and y upwards.
[[nodiscard]] ColourImage picture_of(const PlacePlan& plan);

}  // namespace flyball
