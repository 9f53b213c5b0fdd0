// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the report's top view draws of a world and of a map, as JSON.

#include "flyball/kernels/mapper.h"
#include "flyball/sim/world.h"

#include <vector>

#include <nlohmann/json.hpp>

namespace flyball {

struct HeightBand {
  double low_m{};
  double high_m{};
};

/// Rounded to a thousandth: the page's size is mostly digits. Null when not finite.
[[nodiscard]] nlohmann::ordered_json json_number(double value);

/// Bounds, start, and goal if there is one to fly to; what stands at the heights flown, and under
/// `low` what is lower than these. A ceiling is neither: it would hide the rooms below it.
[[nodiscard]] nlohmann::ordered_json world_json(const World& world,
                                                const HeightBand& flown,
                                                bool has_goal);

/// The map's occupied cells at those heights, as a raster over the bounds.
[[nodiscard]] nlohmann::ordered_json map_json(const std::vector<OccupiedCell>& map,
                                              const Aabb& bounds_W,
                                              const HeightBand& flown);

}  // namespace flyball
