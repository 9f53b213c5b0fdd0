// SPDX-License-Identifier: BSD-3-Clause
//
// Trunks thrown at random, each at least a gap away from the others, so that a map much coarser
// than the vehicle still finds passages between them.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>

namespace {

using flyball::Pillar;
using flyball::Vec3;
using flyball::World;

constexpr double trunk_height_m = 8.0;  // Above the flight ceiling: nothing is overflown.

class Forest final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"goal_distance_m", 150.0, 20.0, 1000.0, "From start to goal, eastwards."},
            {"width_m", 40.0, 10.0, 100.0, "Of the forest, across the way to the goal."},
            {"density_1_m2", 0.02, 0.0, 0.08, "Trunks per square metre."},
            {"min_gap_m", 2.2, 0.0, 10.0, "Least distance between the surfaces of two trunks."},
            {"trunk_radius_m", 0.25, 0.05, 1.0, "Mean; each trunk's is within 40 % of it."},
            {"clear_radius_m", 3.0, 1.0, 20.0, "Free of trunks around start and goal."},
            {"walkers", 0.0, 0.0, 100.0, "Who go to and fro across the way, between the trunks."},
            {"walker_speed_m_s", 0.8, 0.0, 3.0, "Of each of them."}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t seed) const override {
    flyball::World world;
    const double goal_m = given.number("goal_distance_m");
    const double half_width_m = 0.5 * given.number("width_m");
    world.bounds_W = {{-10.0, -half_width_m, 0.9}, {goal_m + 10.0, half_width_m, 2.8}};
    world.goal_W = {goal_m, 0.0, 0.0};
    world.cruise_height_m = 2.0;  // Centre of the .8 m cell [1.6, 2.4), clear of the ground's.
    if (!plant(world, given, seed)) {
      return flyball::Error{
          flyball::ErrorCode::invalid_input,
          "world \"forest\": density_1_m2 = " + std::to_string(given.number("density_1_m2")) +
              " leaves no room for min_gap_m = " + std::to_string(given.number("min_gap_m")) +
              "; lower one of them"};
    }
    add_walkers(world, given, seed);
    return world;
  }

 private:
  // A person's size. They go where no trunk stands in their way, so that nobody walks through one.
  static void add_walkers(World& world, const flyball::Parameters& given, std::uint64_t seed) {
    flyball::RandomStream random{seed, "world/forest/walkers"};
    const double wanted = given.number("walkers");
    const double half_m = 0.5 * given.number("width_m");
    const double shoulder_m = 0.25;
    for (int tries = 0; tries < 2000 && static_cast<double>(world.movers.size()) < wanted;
         ++tries) {
      const double x_m = random.uniform(8.0, world.goal_W.x() - 8.0);
      const double y_m = random.uniform(-0.5, 0.5) * half_m;
      flyball::Mover walker;
      walker.size_m = {2.0 * shoulder_m, 2.0 * shoulder_m, 1.8};
      walker.speed_m_s = given.number("walker_speed_m_s");
      walker.from_W = {x_m, std::max(-half_m, y_m - 6.0), 0.0};
      walker.to_W = {x_m, std::min(half_m, y_m + 6.0), 0.0};
      walker.ahead_m = random.uniform(0.0, 20.0);
      if (is_open(world, walker, 2.0 * shoulder_m)) {
        world.movers.push_back(walker);
      }
    }
  }

  static bool is_open(const World& world, const flyball::Mover& walker, double room_m) {
    return std::none_of(world.pillars.begin(), world.pillars.end(), [&](const Pillar& trunk) {
      const double along_m = trunk.foot_W.y() - walker.from_W.y();
      const double past_m =
          std::max({0.0, -along_m, along_m - (walker.to_W - walker.from_W).norm()});
      return std::hypot(trunk.foot_W.x() - walker.from_W.x(), past_m) < trunk.radius_m + room_m;
    });
  }

  struct Spacing {
    double clear_m;
    double gap_m;
  };

  // Dart throwing. False when a trunk finds no place in 2000 throws: denser than a random packing.
  static bool plant(flyball::World& world, const flyball::Parameters& given, std::uint64_t seed) {
    flyball::RandomStream random{seed, "world/forest"};
    const flyball::Aabb& area = world.bounds_W;
    const Vec3 size = area.max - area.min;
    const double wanted = std::round(given.number("density_1_m2") * size.x() * size.y());
    const double mean_radius_m = given.number("trunk_radius_m");
    const Spacing spacing{given.number("clear_radius_m"), given.number("min_gap_m")};
    int misses = 0;
    while (static_cast<double>(world.pillars.size()) < wanted && misses < 2000) {
      Pillar trunk;
      trunk.foot_W.x() = random.uniform(area.min.x(), area.max.x());
      trunk.foot_W.y() = random.uniform(area.min.y(), area.max.y());
      trunk.radius_m = mean_radius_m * random.uniform(0.6, 1.4);
      trunk.height_m = trunk_height_m;
      if (fits(world, trunk, spacing)) {
        world.pillars.push_back(trunk);
        misses = 0;
      } else {
        ++misses;
      }
    }
    return static_cast<double>(world.pillars.size()) >= wanted;
  }

  static bool fits(const flyball::World& world, const Pillar& trunk, const Spacing& spacing) {
    const auto surface_m = [&](const Vec3& p) {
      return (trunk.foot_W - p).norm() - trunk.radius_m;
    };
    if (std::min(surface_m(world.start_W), surface_m(world.goal_W)) < spacing.clear_m) {
      return false;
    }
    for (const Pillar& other : world.pillars) {
      if (surface_m(other.foot_W) - other.radius_m < spacing.gap_m) {
        return false;
      }
    }
    return true;
  }
};

}  // namespace

FLYBALL_PLUGIN(forest) {
  registry.add<flyball::WorldGenerator>("forest", [] { return std::make_unique<Forest>(); });
}
