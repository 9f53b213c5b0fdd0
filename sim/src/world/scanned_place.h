// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A world whose solids are the occupied cells of a grid, with start and goal where a scenario
/// wants them.

#include "flyball/runtime/parameters.h"
#include "flyball/sim/world.h"

#include "sensors/scan_grid.h"

namespace flyball {

/// The settings that each such world has: start and goal, floor, height and speed of flight.
[[nodiscard]] std::vector<ParameterSpec> place_parameters();

/// On the floor.
struct Trip {
  double start_x_m{}, start_y_m{}, goal_x_m{}, goal_y_m{};
};
[[nodiscard]] Trip trip_of(const Parameters& given);

/// Cells that end below a height are left out: nothing sees or touches what is under the floor.
/// @param lowest_m  That height above the floor: 0 for a scan whose cells begin at the floor, a
///                  cell for one in which the floor itself is made of cells.
/// @param file      Named in errors.
/// @error `invalid_input` when start or goal lies outside of the grid or inside of a solid.
[[nodiscard]] Result<World> world_in(const ScanGrid& grid,
                                     const Trip& trip,
                                     const Parameters& given,
                                     double lowest_m,
                                     const std::string& file);

}  // namespace flyball
