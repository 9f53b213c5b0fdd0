// SPDX-License-Identifier: BSD-3-Clause
//
// Inside one storey of an office building: a corridor with rooms to both sides, each behind a door.
// The vehicle stands at the corridor's west end and knows nothing but the size of the building.
// What is delivered goes to the middle of a room.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include "world/building.h"
#include <algorithm>
#include <string>

namespace {

using flyball::Aabb;
using flyball::Building;
using flyball::BuildingPlan;
using flyball::RandomStream;
using flyball::Vec3;
using flyball::WallStretch;

constexpr double start_from_wall_m = 1.5;
constexpr double office_lowest_m = 0.5;  // Of the body's centre: over nothing but the floor.
constexpr double office_below_ceiling_m =
    0.675;  // The body, its tube, and a hand's breadth of air.

/// All at wall centres.
struct Layout {
  int rooms{};
  double width_m{};
  double depth_m{};
  double corridor_m{};

  [[nodiscard]] double length_m() const { return rooms * width_m; }
  [[nodiscard]] double wall_m(double side) const { return 0.5 * side * corridor_m; }
  [[nodiscard]] double outer_m(double side) const { return side * (0.5 * corridor_m + depth_m); }
};

class Office final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"rooms_per_side", 3.0, 1.0, 20.0, "To each side of the corridor."},
            {"room_width_m", 5.1, 4.2, 20.0, "Along the corridor, between wall centres."},
            {"room_depth_m", 4.8, 4.2, 20.0, "Away from it."},
            {"corridor_width_m", 2.4, 1.8, 10.0, "Between wall centres."},
            {"door_width_m", 0.82, 0.75, 2.0, "MAVBench's door: .82 m."},
            {"furniture_per_room", 3.0, 0.0, 10.0, "Boxes wished per room."},
            {"indoor_speed_m_s", 1.0, 0.1, 10.0, "Limit everywhere."},
            {"door_alignment",
             std::string{"fine"},
             0.0,
             0.0,
             "`fine`: open in .15 m voxels and shut in .80 m ones; `random`: as it comes.",
             {"fine", "random"}},
            {"goal_room", 0.0, 0.0, 40.0,
             "Of a delivery: from the west, odd ones south, even ones north; 0: the start."}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t seed) const override {
    RandomStream random{seed, "world/office"};
    Layout layout;
    layout.rooms = static_cast<int>(given.number("rooms_per_side"));
    layout.width_m = flyball::on_wall_grid(given.number("room_width_m"));
    layout.depth_m = flyball::on_wall_grid(given.number("room_depth_m"));
    layout.corridor_m = 2.0 * flyball::on_wall_grid(0.5 * given.number("corridor_width_m"));
    BuildingPlan plan;
    plan.door_width_m = given.number("door_width_m");
    plan.fine_doors = given.text("door_alignment") == "fine";
    plan.furniture_per_room = static_cast<int>(given.number("furniture_per_room"));

    const int goal_room = static_cast<int>(given.number("goal_room"));
    if (goal_room > 2 * layout.rooms) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "goal_room " + std::to_string(goal_room) + " is not among the " +
                                std::to_string(2 * layout.rooms) +
                                " rooms; rooms_per_side sets how many there are"};
    }
    flyball::World world;
    world.start_W = {start_from_wall_m, 0.0, 0.0};
    world.goal_W = goal_room == 0 ? world.start_W : middle_of_room(layout, goal_room);
    plan.keep_clear_W = world.goal_W;  // There is no furniture in the corridor, near the start.
    const Building building = build(layout, plan, random);
    world.boxes = building.boxes;
    world.volume_W = building.extent_W;
    world.volume_W.max.z() = flyball::ceiling_z_m;
    world.bounds_W = world.volume_W;
    world.bounds_W.min.z() = office_lowest_m;
    world.bounds_W.max.z() -= office_below_ceiling_m;
    // A narrow corridor's walls are nearer than is usual.
    const double to_wall_m = 0.5 * layout.corridor_m - flyball::half_wall_m;
    world.start_clear_m = std::min(world.start_clear_m, to_wall_m);
    if (goal_room == 0) {
      world.goal_clear_m = world.start_clear_m;
    }
    world.zones = {{building.extent_W, given.number("indoor_speed_m_s")}};
    world.cruise_height_m = 1.2;
    return world;
  }

 private:
  static Vec3 middle_of_room(const Layout& layout, int number) {
    const double side = number % 2 == 1 ? -1.0 : 1.0;
    const int column = (number - 1) / 2;
    return {(column + 0.5) * layout.width_m, side * 0.5 * (layout.corridor_m + layout.depth_m),
            0.0};
  }

  static Building build(const Layout& layout, const BuildingPlan& plan, RandomStream& random) {
    Building building;
    building.extent_W.min = {-flyball::half_wall_m, layout.outer_m(-1.0) - flyball::half_wall_m,
                             0.0};
    building.extent_W.max = {layout.length_m() + flyball::half_wall_m,
                             layout.outer_m(1.0) + flyball::half_wall_m, 0.0};
    for (const double x_m : {0.0, layout.length_m()}) {
      add_wall(building, {true, x_m, layout.outer_m(-1.0), layout.outer_m(1.0)});
    }
    for (const double side : {-1.0, 1.0}) {
      add_wall(building, {false, layout.outer_m(side), 0.0, layout.length_m()});
      for (int i = 0; i < layout.rooms; ++i) {
        add_room(building, {layout, i, side}, plan, random);
      }
    }
    add_ceiling(building);
    return building;
  }

  struct Room {
    const Layout& layout;
    int number;
    double side;
  };

  static void add_room(Building& building,
                       const Room& room,
                       const BuildingPlan& plan,
                       RandomStream& random) {
    const Layout& layout = room.layout;
    const double west_m = room.number * layout.width_m;
    const double east_m = west_m + layout.width_m;
    const double inner_m = layout.wall_m(room.side);
    const double outer_m = layout.outer_m(room.side);
    const double south_m = std::min(inner_m, outer_m);
    const double north_m = std::max(inner_m, outer_m);
    const WallStretch to_corridor{false, inner_m, west_m, east_m};
    add_wall_with_door(building, to_corridor, plan, random.uniform(west_m, east_m), random);
    if (room.number > 0) {
      add_wall(building, {true, west_m, south_m, north_m});
    }
    const Vec3 wall{flyball::half_wall_m, flyball::half_wall_m, 0.0};
    furnish(building,
            {Vec3{west_m, south_m, 0.0} + wall, Vec3{east_m, north_m, flyball::ceiling_z_m} - wall},
            plan, random);
  }
};

}  // namespace

FLYBALL_PLUGIN(office) {
  registry.add<flyball::WorldGenerator>("office", [] { return std::make_unique<Office>(); });
}
