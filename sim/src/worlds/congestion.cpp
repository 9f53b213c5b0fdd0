// SPDX-License-Identifier: BSD-3-Clause
//
// RoboRun's worlds (DAC 2021, arXiv 2108.13354): from one crowd of blocks over open ground into
// another one. 27 settings: density {.3, .45, .6} x spread {40, 80, 120} m x goal {600, 900,
// 1200} m. The line to the goal is oblique to the blocks' grid, so no street leads there.

#include "world/congestion.h"

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include <array>
#include <cmath>

namespace {

using flyball::CongestionPlan;
using flyball::Vec3;

constexpr std::array<double, 3> densities{0.3, 0.45, 0.6};
constexpr std::array<double, 3> spreads_m{40.0, 80.0, 120.0};
constexpr std::array<double, 3> goals_m{600.0, 900.0, 1200.0};
constexpr double radians_per_degree = 0.017453292519943295;
constexpr double beside_m = 60.0;  // Of the flight area, around start and goal.

struct Setting {
  double density;
  double spread_m;
  double goal_m;
};

/// Seeds 1 to 27 meet each setting once, and any three in a row all three values of each factor.
Setting setting_of(std::uint64_t seed) {
  const std::uint64_t k = (seed + 26) % 27;
  const std::uint64_t a = k % 3;
  const std::uint64_t b = k / 3 % 3;
  const std::uint64_t c = k / 9;
  return {densities[a], spreads_m[(a + b) % 3], goals_m[(a + b + c) % 3]};
}

class Congestion final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"density", 0.0, 0.0, 1.0,
             "Share of grid points with a block at a peak; 0: .3, .45 or .6, as the seed has it."},
            {"spread_m", 0.0, 0.0, 1000.0, "Radius of a crowd; 0: 40, 80 or 120, by the seed."},
            {"goal_m", 0.0, 0.0, 5000.0, "To the goal; 0: 600, 900 or 1200, by the seed."},
            {"bearing_deg", 0.0, -45.0, 45.0,
             "Of the goal, off the blocks' grid; 0: 10 to 35 to either side, by the seed."}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t seed) const override {
    const auto or_drawn = [&given](const char* key, double drawn) {
      const double value = given.number(key);
      return value > 0.0 ? value : drawn;
    };
    const Setting drawn = setting_of(seed);
    const double goal_m = or_drawn("goal_m", drawn.goal_m);
    flyball::World world;
    const double bearing_rad = bearing_of(given.number("bearing_deg"), seed);
    world.goal_W = goal_m * Vec3{std::cos(bearing_rad), std::sin(bearing_rad), 0.0};
    const Vec3 beside{beside_m, beside_m, 0.0};
    world.bounds_W = {world.start_W.cwiseMin(world.goal_W) - beside,
                      world.start_W.cwiseMax(world.goal_W) + beside};
    world.bounds_W.min.z() = 0.9;
    world.bounds_W.max.z() = 2.8;
    world.cruise_height_m = 2.0;  // Inside a cell of .6, .8, 1.2 or 1.6 m that is not the ground's.
    CongestionPlan plan;
    plan.density = or_drawn("density", drawn.density);
    plan.spread_m = or_drawn("spread_m", drawn.spread_m);
    plan.peaks_W = {world.start_W, world.goal_W};
    plan.area_W = world.bounds_W;
    plan.clear_W = {world.start_W, world.goal_W};
    flyball::RandomStream blocks{seed, "world/congestion/blocks"};
    world.boxes = congested_blocks(plan, blocks);
    return world;
  }

 private:
  static double bearing_of(double wished_deg, std::uint64_t seed) {
    flyball::RandomStream layout{seed, "world/congestion/layout"};
    const double side = layout.uniform() < 0.5 ? -1.0 : 1.0;
    const double drawn_deg = side * layout.uniform(10.0, 35.0);
    return radians_per_degree * (wished_deg == 0.0 ? drawn_deg : wished_deg);
  }
};

}  // namespace

FLYBALL_PLUGIN(congestion) {
  registry.add<flyball::WorldGenerator>("congestion",
                                        [] { return std::make_unique<Congestion>(); });
}
