// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mesh_file
#include "world/scanned_place.h"

#include <array>

namespace flyball {
namespace {

constexpr double far_m = 1e4;
constexpr double body_m = 0.3;  // Half a vehicle's width: less room than that is no place to stand.

World solid_world(const ScanGrid& grid, double ground_z_m, double lowest_m) {
  World world;
  world.ground_z_m = ground_z_m;
  world.bounds_W = grid.extent_W();
  const double floor_cell = (ground_z_m + lowest_m) / grid.resolution_m() + 1e-6;
  world.boxes = merged_boxes(grid, [&](const ScanGrid::Index& cell) {
    return cell.z() + 1 > floor_cell && grid.state(cell) == CellState::occupied;
  });
  return world;
}

std::string shown(const Vec3& p) {
  const auto metres = [](double value) {
    const std::string digits = std::to_string(value);
    return digits.substr(0, digits.find('.') + 3);
  };
  return "(" + metres(p.x()) + ", " + metres(p.y()) + ")";
}

Status check_place(const World& world,
                   const Clearance& clearance,
                   const Aabb& extent,
                   const char* what,
                   const std::string& file) {
  const Vec3& place = std::string{what} == "start" ? world.start_W : world.goal_W;
  const std::string named = std::string{what} + " " + shown(place) + " m";
  const std::string way_out = "; set " + std::string{what} + "_x_m and " + what + "_y_m";
  if (!extent.contains({place.x(), place.y(), extent.min.z()})) {
    return Error{ErrorCode::invalid_input, named + " lies outside of \"" + file +
                                               "\", which reaches from " + shown(extent.min) +
                                               " to " + shown(extent.max) + way_out};
  }
  const Vec3 above = place + Vec3::UnitZ() * world.cruise_height_m;
  if (clearance.distance_m(above, {body_m, 0.1}, 1.0, true) <= 0.0) {
    return Error{ErrorCode::invalid_input,
                 named + " has no room for a vehicle in \"" + file + "\"" + way_out};
  }
  return Done{};
}

/// The room around a place that whoever surveyed it may declare clear, from its floor to the top of
/// the flight band; at most what every made world has.
double clear_around_m(const World& world, const Clearance& clearance, const Vec3& place_W) {
  constexpr double floor_m = 0.1;  // By so much a scanned floor is rough.
  constexpr double step_m = 0.05;
  const double high_m = world.bounds_W.max.z() - place_W.z() - floor_m;
  const Vec3 middle_W = place_W + Vec3::UnitZ() * (floor_m + 0.5 * high_m);
  int steps = 20;
  while (steps > 0 &&
         clearance.distance_m(middle_W, {steps * step_m, 0.5 * high_m}, step_m, true) <= 0.0) {
    --steps;
  }
  return steps * step_m;
}

}  // namespace

std::vector<ParameterSpec> place_parameters() {
  return {
      {"start_x_m", 0.0, -far_m, far_m, "Where the vehicle takes off."},
      {"start_y_m", 0.0, -far_m, far_m, "As start_x_m."},
      {"goal_x_m", 10.0, -far_m, far_m, "Where it delivers."},
      {"goal_y_m", 0.0, -far_m, far_m, "As goal_x_m."},
      {"ground_z_m", 0.0, -far_m, far_m, "Floor in the file; a solid plane closes its holes."},
      {"cruise_height_m", 1.2, 0.5, 100.0, "Above the floor; the band is .3 below to .5 above."},
      {"max_speed_m_s", 1.0, 0.1, 20.0, "In the whole place."}};
}

Trip trip_of(const Parameters& given) {
  return {given.number("start_x_m"), given.number("start_y_m"), given.number("goal_x_m"),
          given.number("goal_y_m")};
}

Result<World> world_in(const ScanGrid& grid,
                       const Trip& trip,
                       const Parameters& given,
                       double lowest_m,
                       const std::string& file) {
  const Aabb extent = grid.extent_W();
  if (extent.min.cwiseAbs().maxCoeff() > far_m || extent.max.cwiseAbs().maxCoeff() > far_m) {
    return Error{ErrorCode::invalid_input,
                 "\"" + file + "\" reaches farther than 10 km from its origin; crop it, or set " +
                     "metres_per_unit if it is a mesh in other units"};
  }
  World world = solid_world(grid, given.number("ground_z_m"), lowest_m);
  world.start_W = {trip.start_x_m, trip.start_y_m, world.ground_z_m};
  world.goal_W = {trip.goal_x_m, trip.goal_y_m, world.ground_z_m};
  world.cruise_height_m = given.number("cruise_height_m");
  world.zones = {{world.bounds_W, given.number("max_speed_m_s")}};
  world.bounds_W.min.z() = world.ground_z_m + world.cruise_height_m - 0.3;
  world.bounds_W.max.z() = world.ground_z_m + world.cruise_height_m + 0.5;
  const Clearance clearance{world};
  for (const char* what : {"start", "goal"}) {
    if (const Status good = check_place(world, clearance, grid.extent_W(), what, file); !good) {
      return good.error();
    }
  }
  world.start_clear_m = clear_around_m(world, clearance, world.start_W);
  world.goal_clear_m = clear_around_m(world, clearance, world.goal_W);
  return world;
}

}  // namespace flyball
