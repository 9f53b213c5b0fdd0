// SPDX-License-Identifier: BSD-3-Clause
//
// Blocks of houses between streets that cross at right angles, some blocks open squares with trees;
// lamps along the kerbs, parked cars, and lorries that go to and fro, if wanted. Flown below the
// roofs, so the path follows the streets.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>

namespace {

using flyball::Aabb;
using flyball::Material;
using flyball::Parameters;
using flyball::RandomStream;
using flyball::Vec3;
using flyball::World;

constexpr double kerb_m = 2.5;  // Pavement between houses and street: lamps stand there.
constexpr double lamp_every_m = 25.0;
constexpr double lamp_radius_m = 0.1;
constexpr double lamp_height_m = 8.0;
constexpr double trunk_radius_m = 0.25;
constexpr double tree_height_m = 9.0;
const Vec3 car_m{4.5, 1.8, 1.5};
const Vec3 lorry_m{8.0, 2.5, 3.5};
constexpr double clear_m = 6.0;  // Around start and goal.

struct Grid {
  double block_m;
  double street_m;
  int columns;
  int rows;
  [[nodiscard]] double pitch_m() const { return block_m + street_m; }
  /// Middle of the street west of column `i`, or south of row `i`.
  [[nodiscard]] double street_at(int i) const { return i * pitch_m(); }
};

/// Whether a disc keeps away from start and goal.
bool is_away(const World& world, const Vec3& p, double radius_m) {
  const auto far_from = [&](const Vec3& place) {
    return (p - place).head<2>().norm() > clear_m + radius_m;
  };
  return far_from(world.start_W) && far_from(world.goal_W);
}

void add_box(World& world, const Vec3& foot_W, const Vec3& size_m, Material material) {
  const Vec3 half{0.5 * size_m.x(), 0.5 * size_m.y(), 0.0};
  world.boxes.push_back({foot_W - half, foot_W + half + Vec3::UnitZ() * size_m.z()});
  world.box_materials.push_back(material);
}

class CityBlocks final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"columns", 4.0, 1.0, 30.0, "Blocks from start to goal, eastwards."},
            {"rows", 2.0, 1.0, 30.0, "Blocks from start to goal, northwards."},
            {"block_m", 40.0, 15.0, 200.0, "Side of a block."},
            {"street_m", 12.0, 6.0, 40.0, "From house to house."},
            {"roof_m", 20.0, 8.0, 200.0, "Mean height; each house's is within 50 % of it."},
            {"squares", 0.15, 0.0, 1.0, "Share of the blocks that are squares with trees."},
            {"cars_1_km", 60.0, 0.0, 200.0,
             "Parked on one side of streets that run east, per kilometre of block."},
            {"lorries", 0.0, 0.0, 100.0, "That go to and fro between two crossings."},
            {"lorry_speed_m_s", 5.0, 0.0, 15.0, "Of each of them."},
            {"cruise_height_m", 2.0, 2.0, 6.0, "Above the street."}};
  }

  [[nodiscard]] flyball::Result<World> make(const Parameters& given,
                                            std::uint64_t seed) const override {
    const Grid grid{given.number("block_m"), given.number("street_m"),
                    static_cast<int>(given.number("columns")),
                    static_cast<int>(given.number("rows"))};
    if (given.number("lorries") > 0.0 && grid.columns < 2) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "world \"city_blocks\": lorries go to and fro in the streets between "
                            "start and goal, and with columns = 1 there is none; set columns to 2 "
                            "or more, or lorries to 0"};
    }
    World world;
    world.ground_material = Material::asphalt;
    world.goal_W = {grid.street_at(grid.columns), grid.street_at(grid.rows), 0.0};
    world.cruise_height_m = given.number("cruise_height_m");
    const double rim_m = 0.5 * grid.street_m;
    world.bounds_W = {
        {-rim_m, -rim_m, world.cruise_height_m - 1.1},
        {world.goal_W.x() + rim_m, world.goal_W.y() + rim_m, world.cruise_height_m + 0.8}};
    add_blocks(world, grid, given, seed);
    add_lamps(world, grid);
    add_cars(world, grid, given.number("cars_1_km"), seed);
    add_lorries(world, grid, given, seed);
    return world;
  }

 private:
  /// A ring of blocks around those that can be flown along hides the ends of the streets.
  static void add_blocks(World& world,
                         const Grid& grid,
                         const Parameters& given,
                         std::uint64_t seed) {
    RandomStream random{seed, "world/city_blocks/blocks"};
    for (int row = -1; row <= grid.rows; ++row) {
      for (int column = -1; column <= grid.columns; ++column) {
        const Vec3 corner{grid.street_at(column) + 0.5 * grid.street_m,
                          grid.street_at(row) + 0.5 * grid.street_m, 0.0};
        const bool is_inside = row >= 0 && row < grid.rows && column >= 0 && column < grid.columns;
        const double height_m = given.number("roof_m") * random.uniform(0.5, 1.5);
        if (random.uniform() < given.number("squares") && is_inside) {
          add_square(world, corner, grid.block_m, random);
        } else {
          const Vec3 size{grid.block_m, grid.block_m, height_m};
          world.boxes.push_back({corner, corner + size});
          world.box_materials.push_back(Material::brick);
        }
      }
    }
  }

  /// Trees on a 6 m grid, each somewhere within 1.5 m of its place: passages of 2.5 m between them.
  static void add_square(World& world, const Vec3& corner, double side_m, RandomStream& random) {
    constexpr double pitch_m = 6.0;
    constexpr double play_m = 1.5;
    const int trees = static_cast<int>(side_m / pitch_m);
    for (int i = 0; i < trees * trees; ++i) {
      const int row = i / trees;
      Vec3 foot_W = corner + pitch_m * Vec3{i % trees + 0.5, row + 0.5, 0.0};
      foot_W.x() += random.uniform(-play_m, play_m);
      foot_W.y() += random.uniform(-play_m, play_m);
      world.pillars.push_back({foot_W, trunk_radius_m, tree_height_m, Material::bark});
    }
  }

  static void add_lamps(World& world, const Grid& grid) {
    const double off_m = 0.5 * grid.street_m - kerb_m;
    const auto along = [&](bool is_eastwards, int street, double length_m) {
      for (double s_m = 0.5 * lamp_every_m; s_m < length_m; s_m += lamp_every_m) {
        const double across_m = grid.street_at(street) + off_m;
        const Vec3 foot_W = is_eastwards ? Vec3{s_m, across_m, 0.0} : Vec3{across_m, s_m, 0.0};
        if (is_away(world, foot_W, lamp_radius_m)) {
          world.pillars.push_back({foot_W, lamp_radius_m, lamp_height_m, Material::plaster});
        }
      }
    };
    for (int row = 0; row <= grid.rows; ++row) {
      along(true, row, grid.street_at(grid.columns));
    }
    for (int column = 0; column <= grid.columns; ++column) {
      along(false, column, grid.street_at(grid.rows));
    }
  }

  /// One in its slot of the kerb opposite the lamps; crossings stay free.
  static void add_cars(World& world, const Grid& grid, double wanted_1_km, std::uint64_t seed) {
    RandomStream random{seed, "world/city_blocks/cars"};
    constexpr double slot_m = 6.0;
    const double chance = std::min(1.0, 1e-3 * wanted_1_km * slot_m);
    const double across_m = -0.5 * grid.street_m + kerb_m;
    const int slots = static_cast<int>(grid.block_m / slot_m);
    for (int row = 0; row <= grid.rows; ++row) {
      for (int i = 0; i < grid.columns * slots; ++i) {
        const double x_m =
            grid.street_at(i / slots) + 0.5 * grid.street_m + (i % slots + 0.5) * slot_m;
        const Vec3 foot_W{x_m, grid.street_at(row) + across_m, 0.0};
        if (random.uniform() < chance && is_away(world, foot_W, car_m.x())) {
          add_box(world, foot_W, car_m, Material::plaster);
        }
      }
    }
  }

  static void add_lorries(World& world,
                          const Grid& grid,
                          const Parameters& given,
                          std::uint64_t seed) {
    RandomStream random{seed, "world/city_blocks/lorries"};
    const auto wanted = static_cast<int>(given.number("lorries"));
    for (int i = 0; i < wanted; ++i) {
      const int street = 1 + static_cast<int>(random.uniform() * (grid.columns - 1));
      const double x_m = grid.street_at(std::min(street, grid.columns));
      flyball::Mover lorry;
      lorry.size_m = {lorry_m.y(), lorry_m.x(), lorry_m.z()};
      lorry.speed_m_s = given.number("lorry_speed_m_s");
      lorry.from_W = {x_m, 0.5 * lorry_m.x(), 0.0};
      lorry.to_W = {x_m, grid.street_at(grid.rows) - 0.5 * lorry_m.x(), 0.0};
      lorry.ahead_m = random.uniform(0.0, 2.0 * grid.street_at(grid.rows));
      if (is_away(world, {x_m, 0.0, 0.0}, lorry_m.x()) &&
          is_away(world, {x_m, grid.street_at(grid.rows), 0.0}, lorry_m.x())) {
        world.movers.push_back(lorry);
      }
    }
  }
};

}  // namespace

FLYBALL_PLUGIN(city_blocks) {
  registry.add<flyball::WorldGenerator>("city_blocks",
                                        [] { return std::make_unique<CityBlocks>(); });
}
