// SPDX-License-Identifier: BSD-3-Clause
//
// A farm to be surveyed from above: fields of low crop with fences between them, a barn and trees
// at their edges. All of it ends below a height that is known before take-off.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>

namespace {

using flyball::Aabb;
using flyball::Parameters;
using flyball::Pillar;
using flyball::RandomStream;
using flyball::Vec3;
using flyball::World;

constexpr double margin_m = 30.0;       // Around the fields: start, trees, barn, and room to turn.
constexpr double yard_m = 6.0;          // Free of everything around start, at every height.
constexpr double fence_height_m = 1.2;  // A stock fence's.
constexpr double fence_width_m = 0.1;
constexpr double gate_m = 4.0;  // Left open in each fence.
constexpr double barn_length_m = 18.0;
constexpr double barn_width_m = 10.0;
constexpr double barn_height_m = 7.0;
constexpr double farm_trunk_radius_m = 0.3;
constexpr double crown_share = 0.45;  // Of the tree's height, from the top down.
constexpr double ceiling_m = 60.0;

class Farm final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {
        {"length_m", 100.0, 20.0, 1000.0, "Of the fields, eastwards."},
        {"width_m", 100.0, 20.0, 1000.0, "Of the fields, northwards."},
        {"fields", 4.0, 1.0, 20.0, "Strips of crop, each with a fence between it and the next."},
        {"crop_height_m", 0.6, 0.0, 3.0, "Mean; each field's is within 50 % of it."},
        {"trees", 40.0, 0.0, 1000.0, "Around the fields, and a few in them."},
        {"tree_height_m", 8.0, 2.0, 30.0, "The tallest; the lowest have half of it."}};
  }

  [[nodiscard]] flyball::Result<World> make(const Parameters& given,
                                            std::uint64_t seed) const override {
    World world;
    const Vec3 size{given.number("length_m"), given.number("width_m"), 0.0};
    const double highest_m = std::max(
        {barn_height_m, given.number("tree_height_m"), 1.5 * given.number("crop_height_m")});
    world.bounds_W = {{-margin_m, -margin_m, 1.0},
                      {size.x() + margin_m, size.y() + margin_m, ceiling_m}};
    world.open_above_m = highest_m;
    world.start_W = world.goal_W = Vec3{-0.5 * margin_m, -0.5 * margin_m, 0.0};
    world.cruise_height_m = highest_m + 2.0;
    RandomStream random{seed, "world/farm"};
    add_fields(world, size, given, random);
    add_barn(world, size, random);
    add_trees(world, size, given, random);
    return world;
  }

 private:
  static void add_fields(World& world,
                         const Vec3& size,
                         const Parameters& given,
                         RandomStream& random) {
    const auto fields = static_cast<int>(std::lround(given.number("fields")));
    const double strip_m = size.y() / fields;
    for (int i = 0; i < fields; ++i) {
      const double y_m = i * strip_m;
      const double crop_m = given.number("crop_height_m") * random.uniform(0.5, 1.5);
      constexpr double path_m = 1.0;  // Beside each fence.
      if (crop_m > 0.0 && strip_m > 2.0 * path_m) {
        world.boxes.push_back(
            {{path_m, y_m + path_m, 0.0}, {size.x() - path_m, y_m + strip_m - path_m, crop_m}});
      }
      if (i > 0) {
        add_fence(world, size.x(), y_m, random.uniform(0.0, size.x() - gate_m));
      }
    }
  }

  static void add_fence(World& world, double length_m, double y_m, double gate_at_m) {
    const auto rail = [&](double from_m, double to_m) {
      if (to_m > from_m) {
        world.boxes.push_back({{from_m, y_m - 0.5 * fence_width_m, 0.0},
                               {to_m, y_m + 0.5 * fence_width_m, fence_height_m}});
      }
    };
    rail(0.0, gate_at_m);
    rail(gate_at_m + gate_m, length_m);
  }

  /// North of the fields, somewhere along them.
  static void add_barn(World& world, const Vec3& size, RandomStream& random) {
    const double x_m = random.uniform(0.0, size.x() - barn_length_m);
    const double y_m = size.y() + random.uniform(4.0, margin_m - barn_width_m - 2.0);
    world.boxes.push_back(
        {{x_m, y_m, 0.0}, {x_m + barn_length_m, y_m + barn_width_m, barn_height_m}});
  }

  /// A trunk and a box for its crown. Nine of ten stand around the fields.
  static void add_trees(World& world,
                        const Vec3& size,
                        const Parameters& given,
                        RandomStream& random) {
    const auto trees = static_cast<int>(std::lround(given.number("trees")));
    for (int i = 0; i < trees; ++i) {
      const double height_m = given.number("tree_height_m") * random.uniform(0.5, 1.0);
      const double crown_m = crown_share * height_m;
      const double half_m = 0.4 * crown_m;
      const Vec3 foot_W = random.uniform() < 0.1 ? inside(size, random) : around(size, random);
      const double yard = (foot_W - world.start_W).head<2>().cwiseAbs().maxCoeff();
      if (yard < yard_m + half_m) {
        continue;
      }
      world.pillars.push_back({foot_W, farm_trunk_radius_m, height_m - crown_m});
      world.boxes.push_back({foot_W + Vec3{-half_m, -half_m, height_m - crown_m},
                             foot_W + Vec3{half_m, half_m, height_m}});
    }
  }

  static Vec3 inside(const Vec3& size, RandomStream& random) {
    const double x_m = random.uniform(0.0, size.x());
    return {x_m, random.uniform(0.0, size.y()), 0.0};
  }

  /// In the margin: one of the four sides, then along and across it.
  static Vec3 around(const Vec3& size, RandomStream& random) {
    const auto side = static_cast<int>(4.0 * random.uniform());
    const double along = random.uniform(-0.5 * margin_m, 0.5 * margin_m);
    const double across_m = random.uniform(2.0, margin_m - 4.0);
    const double share = random.uniform();
    switch (side) {
      case 0:
        return {share * size.x() + along, -across_m, 0.0};
      case 1:
        return {share * size.x() + along, size.y() + across_m, 0.0};
      case 2:
        return {-across_m, share * size.y() + along, 0.0};
      default:
        return {size.x() + across_m, share * size.y() + along, 0.0};
    }
  }
};

}  // namespace

FLYBALL_PLUGIN(farm) {
  registry.add<flyball::WorldGenerator>("farm", [] { return std::make_unique<Farm>(); });
}
