// SPDX-License-Identifier: BSD-3-Clause
//
// Across an open field with a few solid blocks, then through the one door of a building to a room
// at its far end: outdoors a coarse map is enough, indoors only a fine one shows that doors are
// open.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include "world/building.h"
#include <algorithm>
#include <cmath>

namespace {

using flyball::Aabb;
using flyball::BuildingPlan;
using flyball::Vec3;

constexpr double area_half_width_m = 40.0;  // Of the flight area.
constexpr double clear_of_blocks_m = 6.0;   // Around the start and before the facade.
constexpr double block_height_m = 4.0;      // Above the flight ceiling.
constexpr double door_apron_m = 1.5;        // Before the door the vehicle has slowed down.
constexpr double goal_behind_wall_m = 3.0;  // The goal's room begins this far before it.

class OutdoorToIndoor final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"outdoors_m", 300.0, 15.0, 2000.0, "From start to facade."},
            {"indoors_m", 30.0, 10.0, 100.0, "From facade to goal."},
            {"block_spacing_m", 25.0, 10.0, 200.0, "Mean distance between blocks outdoors."},
            {"door_width_m", 0.82, 0.75, 2.0, "MAVBench's door: .82 m."},
            {"furniture_per_room", 4.0, 0.0, 10.0, "Boxes wished per room."},
            {"indoor_speed_m_s", 1.0, 0.1, 10.0, "Limit in the building and 1.5 m around it."},
            {"door_alignment",
             std::string{"fine"},
             0.0,
             0.0,
             "`fine`: open in .15 m voxels and shut in .80 m ones; `random`: as it comes.",
             {"fine", "random"}}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t seed) const override {
    flyball::RandomStream layout{seed, "world/outdoor_to_indoor/layout"};
    flyball::RandomStream building_stream{seed, "world/outdoor_to_indoor/building"};
    flyball::RandomStream blocks{seed, "world/outdoor_to_indoor/blocks"};
    flyball::World world;
    const double indoors_m = given.number("indoors_m");
    BuildingPlan plan = plan_rooms(flyball::on_wall_grid(given.number("outdoors_m")), indoors_m);
    world.goal_W = {plan.facade_x_m + indoors_m, layout.uniform(-3.0, 3.0), 0.0};
    const double line_y_m = world.goal_W.y() * plan.facade_x_m / world.goal_W.x();
    plan.entrance_y_m = line_y_m + layout.uniform(-4.0, 4.0);
    plan.door_width_m = given.number("door_width_m");
    plan.fine_doors = given.text("door_alignment") == "fine";
    plan.furniture_per_room = static_cast<int>(given.number("furniture_per_room"));
    plan.keep_clear_W = world.goal_W;

    const flyball::Building building = make_building(plan, building_stream);
    world.boxes = building.boxes;
    scatter_blocks(world, plan.facade_x_m, given.number("block_spacing_m"), blocks);
    const Vec3 around{door_apron_m, door_apron_m, door_apron_m};
    world.zones = {{{building.extent_W.min - around, building.extent_W.max + around},
                    given.number("indoor_speed_m_s")}};
    world.bounds_W = {{-10.0, -area_half_width_m, 0.9},
                      {building.extent_W.max.x() + 20.0, area_half_width_m, 1.7}};
    world.cruise_height_m = 1.2;  // Centre of the .8 m cell [.8, 1.6).
    return world;
  }

 private:
  // Rooms about 10 m deep such that the goal stands 3 m inside the last row.
  static BuildingPlan plan_rooms(double facade_x_m, double indoors_m) {
    BuildingPlan plan;
    plan.facade_x_m = facade_x_m;
    const double before_last_m = indoors_m - goal_behind_wall_m;
    const double rows = std::max(1.0, std::round(before_last_m / 10.0));
    plan.room_depth_m = flyball::on_wall_grid(before_last_m / rows);
    plan.rows = static_cast<int>(rows) + 1;
    return plan;
  }

  // One block in each cell of a grid as wide as the spacing, anywhere in its cell but a passage
  // away from the cell's border: no two blocks close a gap between them.
  static void scatter_blocks(flyball::World& world,
                             double facade_x_m,
                             double spacing_m,
                             flyball::RandomStream& random) {
    constexpr double margin_m = 1.5;
    const int rows = static_cast<int>(std::ceil(facade_x_m / spacing_m));
    const int columns = std::max(1, static_cast<int>(2.0 * area_half_width_m / spacing_m));
    const double pitch_y_m = 2.0 * area_half_width_m / columns;
    for (int i = 0; i < rows * columns; ++i) {
      const int row = i / columns;
      const int column = i % columns;
      const double x_m = row * spacing_m;
      const double y_m = -area_half_width_m + column * pitch_y_m;
      Vec3 size{0.0, 0.0, block_height_m};
      Vec3 corner = Vec3::Zero();
      size.x() = random.uniform(1.5, 4.0);
      size.y() = random.uniform(1.5, 4.0);
      corner.x() = x_m + random.uniform(margin_m, spacing_m - size.x() - margin_m);
      corner.y() = y_m + random.uniform(margin_m, pitch_y_m - size.y() - margin_m);
      const Aabb block{corner, corner + size};
      if (block.distance_m(world.start_W) >= clear_of_blocks_m &&
          block.max.x() <= facade_x_m - clear_of_blocks_m) {
        world.boxes.push_back(block);
      }
    }
  }
};

}  // namespace

FLYBALL_PLUGIN(outdoor_to_indoor) {
  registry.add<flyball::WorldGenerator>("outdoor_to_indoor",
                                        [] { return std::make_unique<OutdoorToIndoor>(); });
}
