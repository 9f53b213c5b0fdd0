// SPDX-License-Identifier: BSD-3-Clause
//
// Nothing but the ground: what a mission costs when no obstacle slows it.

#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

namespace {

class Empty final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"goal_distance_m", 300.0, 5.0, 5000.0, "From start to goal, eastwards."}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t) const override {
    flyball::World world;
    const double goal_m = given.number("goal_distance_m");
    world.bounds_W = {{-20.0, -40.0, 0.9}, {goal_m + 20.0, 40.0, 2.8}};
    world.goal_W = {goal_m, 0.0, 0.0};
    world.cruise_height_m = 2.0;  // Centre of the .8 m cell [1.6, 2.4), clear of the ground's.
    return world;
  }
};

}  // namespace

FLYBALL_PLUGIN(empty) {
  registry.add<flyball::WorldGenerator>("empty", [] { return std::make_unique<Empty>(); });
}
