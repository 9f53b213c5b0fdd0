// SPDX-License-Identifier: BSD-3-Clause
//
// Nothing but the ground: what a mission costs when no obstacle slows it.

#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>

namespace {

class Empty final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"goal_distance_m", 300.0, 5.0, 5000.0, "From start to goal."},
            {"bearing_deg", 0.0, -180.0, 180.0, "Of the goal, from east, anticlockwise."},
            {"clear_m", 1.0, 0.5, 20.0, "Declared clear around the verticals of start and goal."},
            {"clear_height_m", 2.5, 2.5, 20.0, "Up to which that counts."}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t) const override {
    flyball::World world;
    constexpr double pi = 3.14159265358979323846;
    const double goal_m = given.number("goal_distance_m");
    const double bearing_rad = given.number("bearing_deg") * pi / 180.0;
    const double east_m = goal_m * std::cos(bearing_rad);
    const double north_m = goal_m * std::sin(bearing_rad);
    world.start_clear_m = world.goal_clear_m = given.number("clear_m");
    world.clear_height_m = given.number("clear_height_m");
    world.bounds_W = {{std::min(0.0, east_m) - 20.0, std::min(0.0, north_m) - 40.0, 0.9},
                      {std::max(0.0, east_m) + 20.0, std::max(0.0, north_m) + 40.0,
                       std::max(2.8, world.clear_height_m)}};
    world.goal_W = {east_m, north_m, 0.0};
    world.cruise_height_m = 2.0;  // Centre of the .8 m cell [1.6, 2.4), clear of the ground's.
    return world;
  }
};

}  // namespace

FLYBALL_PLUGIN(empty) {
  registry.add<flyball::WorldGenerator>("empty", [] { return std::make_unique<Empty>(); });
}
