// SPDX-License-Identifier: BSD-3-Clause
//
// A strip of land on which everything takes its turn: open stretches, crowds of blocks, walls with
// one narrow slit, and buildings that have to be crossed from door to door. What stands in the way
// spans the strip, so nothing is flown around. No one setting of a map suits all of it.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/sim/world.h"

#include "world/building.h"
#include "world/congestion.h"
#include <algorithm>

namespace {

using flyball::Aabb;
using flyball::BuildingPlan;
using flyball::RandomStream;
using flyball::Vec3;
using flyball::World;

constexpr double half_width_m = 15.3;  // Three rooms of 10.2 m.
constexpr double room_m = 10.05;       // Wall centres are multiples of .15 m.
constexpr int rows = 6;                // A building is 60 m deep.
constexpr double crowd_m = 80.0;
constexpr double slit_wall_m = 3.0;    // Depth of a wall with a slit.
constexpr double open_m = 20.0;        // At least, before and behind each thing.
constexpr double apron_m = 1.5;        // Before a door the vehicle has slowed down.
constexpr double wall_height_m = 6.0;  // Above the flight ceiling.

enum class Thing : std::uint8_t { building, crowd, slit };

double depth_m(Thing thing) {
  return thing == Thing::building ? rows * room_m : thing == Thing::crowd ? crowd_m : slit_wall_m;
}

class Mixed final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"length_m", 0.0, 0.0, 5000.0, "From start to goal; 0: 600 to 1200, by the seed."},
            {"buildings", 0.0, -1.0, 10.0, "0: one or two, by the seed; -1: none."},
            {"crowds", 2.0, 0.0, 10.0, "Of blocks, 80 m deep."},
            {"slits", 0.0, -1.0, 10.0, "Walls with a slit; 0: one or two, by the seed; -1: none."},
            {"narrowest_m", 0.82, 0.75, 1.2,
             "Door; widths are drawn up to 1.6 m, slits from .3 m more to 1.5 m."},
            {"furniture_per_room", 3.0, 0.0, 10.0, "Boxes wished per room."},
            {"indoor_speed_m_s", 1.0, 0.1, 10.0, "Limit in a building and 1.5 m around it."},
            {"door_alignment",
             std::string{"fine"},
             0.0,
             0.0,
             "`fine`: on .15 m voxels, widths in steps of two; `random`: as it comes.",
             {"fine", "random"}}};
  }

  [[nodiscard]] flyball::Result<World> make(const flyball::Parameters& given,
                                            std::uint64_t seed) const override {
    RandomStream layout{seed, "world/mixed/layout"};
    const double drawn_m = layout.uniform(600.0, 1200.0);
    const double length_m = given.number("length_m") > 0.0 ? given.number("length_m") : drawn_m;
    const std::vector<Thing> things = sequence(given, layout);
    double spare_m = length_m - open_m;
    for (const Thing thing : things) {
      spare_m -= depth_m(thing) + open_m;
    }
    if (spare_m < 0.0) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "world \"mixed\": length_m = " + flyball::short_number_text(length_m) +
                                " must be at least " +
                                flyball::short_number_text(length_m - spare_m) +
                                " for what stands on it; lengthen it, or lower buildings, crowds "
                                "or slits"};
    }
    World world;
    world.goal_W = {length_m, 0.0, 0.0};
    world.bounds_W = {{-10.0, -half_width_m, 1.2}, {length_m + 10.0, half_width_m, 1.9}};
    world.cruise_height_m = 1.5;  // Amid cells of .3, .6 and 1 m; 1.2 m cells begin at the floor's.
    place(world, things, cuts(spare_m, things.size(), layout), given, seed);
    return world;
  }

 private:
  static std::vector<Thing> sequence(const flyball::Parameters& given, RandomStream& layout) {
    const auto count = [&](const char* key) {
      const auto drawn = 1 + static_cast<int>(layout.uniform(0.0, 2.0));
      const int wished = static_cast<int>(given.number(key));
      return wished == 0 ? drawn : std::max(0, wished);
    };
    std::vector<Thing> things;
    things.insert(things.end(), static_cast<std::size_t>(count("buildings")), Thing::building);
    things.insert(things.end(), static_cast<std::size_t>(given.number("crowds")), Thing::crowd);
    things.insert(things.end(), static_cast<std::size_t>(count("slits")), Thing::slit);
    for (std::size_t i = things.size(); i > 1; --i) {  // Fisher and Yates.
      std::swap(things[i - 1], things[layout.next() % i]);
    }
    return things;
  }

  /// Open ground before each thing beyond the least, in order; their sum leaves some for the end.
  static std::vector<double> cuts(double spare_m, std::size_t things, RandomStream& layout) {
    std::vector<double> at(things);
    std::generate(at.begin(), at.end(), [&] { return layout.uniform(0.0, spare_m); });
    std::sort(at.begin(), at.end());
    return at;
  }

  static void place(World& world,
                    const std::vector<Thing>& things,
                    const std::vector<double>& spare_before_m,
                    const flyball::Parameters& given,
                    std::uint64_t seed) {
    double used_m = 0.0;
    for (std::size_t i = 0; i < things.size(); ++i) {
      const double at_m = flyball::on_wall_grid(used_m + open_m + spare_before_m[i]);
      RandomStream random{seed, "world/mixed/thing", i};
      switch (things[i]) {
        case Thing::building:
          add_building(world, at_m, given, random);
          break;
        case Thing::crowd:
          add_crowd(world, at_m, random);
          break;
        case Thing::slit:
          add_slit(world, at_m, given, random);
          break;
      }
      used_m += open_m + depth_m(things[i]);
    }
  }

  static BuildingPlan plan_of(const flyball::Parameters& given, double at_m) {
    BuildingPlan plan;
    plan.facade_x_m = at_m;
    plan.rows = rows;
    plan.room_depth_m = room_m;
    plan.door_width_m = given.number("narrowest_m");
    plan.most_door_width_m = 1.6;
    plan.has_exit = true;
    plan.fine_doors = given.text("door_alignment") == "fine";
    plan.furniture_per_room = static_cast<int>(given.number("furniture_per_room"));
    return plan;
  }

  static void add_building(World& world,
                           double at_m,
                           const flyball::Parameters& given,
                           RandomStream& random) {
    BuildingPlan plan = plan_of(given, at_m);
    plan.entrance_y_m = random.uniform(-4.0, 4.0);
    const flyball::Building building = make_building(plan, random);
    world.boxes.insert(world.boxes.end(), building.boxes.begin(), building.boxes.end());
    const Vec3 around{apron_m, apron_m, apron_m};
    world.zones.push_back({{building.extent_W.min - around, building.extent_W.max + around},
                           given.number("indoor_speed_m_s")});
  }

  static void add_crowd(World& world, double at_m, RandomStream& random) {
    flyball::CongestionPlan plan;
    plan.density = random.uniform(0.3, 0.6);
    plan.spread_m = crowd_m;
    plan.peaks_W = {{at_m + 0.5 * crowd_m, 0.0, 0.0}};
    plan.area_W = {{at_m, -half_width_m, 0.0}, {at_m + crowd_m, half_width_m, 0.0}};
    plan.height_m = wall_height_m;
    for (const flyball::Aabb& block : congested_blocks(plan, random)) {
      world.boxes.push_back(block);
    }
  }

  static void add_slit(World& world,
                       double at_m,
                       const flyball::Parameters& given,
                       RandomStream& random) {
    BuildingPlan plan = plan_of(given, at_m);
    // One step wider than a narrow door: a slit is 3 m long.
    const double least_m =
        plan.fine_doors ? plan.door_width_m + 0.3 : std::max(0.9, plan.door_width_m);
    plan.door_width_m = flyball::door_width_m(least_m, 1.5, plan.fine_doors, random);
    const double wish_m = random.uniform(-10.0, 10.0);
    const double centre_m = door_centre_m(plan, wish_m, -12.0, 12.0);
    const double half_slit_m = 0.5 * plan.door_width_m;
    const double end_m = half_width_m + 0.075;
    world.boxes.push_back(
        {{at_m, -end_m, 0.0}, {at_m + slit_wall_m, centre_m - half_slit_m, wall_height_m}});
    world.boxes.push_back(
        {{at_m, centre_m + half_slit_m, 0.0}, {at_m + slit_wall_m, end_m, wall_height_m}});
  }
};

}  // namespace

FLYBALL_PLUGIN(mixed) {
  registry.add<flyball::WorldGenerator>("mixed", [] { return std::make_unique<Mixed>(); });
}
