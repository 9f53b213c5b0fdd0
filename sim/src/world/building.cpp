// SPDX-License-Identifier: BSD-3-Clause
#include "world/building.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double voxel_m = 0.15;     // MAVBench's resolution for delivery and mapping.
constexpr double coarse_m = 0.80;    // MAVBench's coarse resolution.
constexpr double lintel_z_m = 2.13;  // DIN 18100: door openings are 2.125 to 2.135 m high.
constexpr double roof_z_m = 2.925;
constexpr double furniture_gap_m = 1.3;  // The body passes on both maps' terms.
constexpr double corner_m = 0.5;         // Between a door's jamb and the wall across.

Aabb upright(const WallStretch& s, double low_m, double high_m, double bottom_m, double top_m) {
  const double front = s.at_m - half_wall_m;
  const double back = s.at_m + half_wall_m;
  if (s.along_y) {
    return {{front, low_m, bottom_m}, {back, high_m, top_m}};
  }
  return {{low_m, front, bottom_m}, {high_m, back, top_m}};
}

double wall_x_m(const BuildingPlan& plan, int row) {
  return plan.facade_x_m + row * plan.room_depth_m;
}

double wall_y_m(const BuildingPlan& plan, int column) {
  return (column - 0.5 * plan.columns) * plan.room_width_m;
}

void add_walls_along_y(Building& building, const BuildingPlan& plan, RandomStream& random) {
  for (int i = 0; i < (plan.rows + 1) * plan.columns; ++i) {
    const int row = i / plan.columns;
    const int column = i % plan.columns;
    const WallStretch s{true, wall_x_m(plan, row), wall_y_m(plan, column),
                        wall_y_m(plan, column + 1)};
    if (row == 0 && column == plan.columns / 2) {
      add_wall_with_door(building, s, plan, plan.entrance_y_m, random);
    } else if (row == 0 || (row == plan.rows && !(plan.has_exit && column == plan.columns / 2))) {
      add_wall(building, s);
    } else {
      const double wish_m = random.uniform(s.low_m, s.high_m);
      add_wall_with_door(building, s, plan, wish_m, random);
    }
  }
}

void add_walls_along_x(Building& building, const BuildingPlan& plan, RandomStream& random) {
  for (int i = 0; i < (plan.columns + 1) * plan.rows; ++i) {
    const int column = i / plan.rows;
    const int row = i % plan.rows;
    const WallStretch s{false, wall_y_m(plan, column), wall_x_m(plan, row),
                        wall_x_m(plan, row + 1)};
    if (column == 0 || column == plan.columns) {
      add_wall(building, s);
    } else {
      const double wish_m = random.uniform(s.low_m, s.high_m);
      add_wall_with_door(building, s, plan, wish_m, random);
    }
  }
}

// Horizontal distance between two boxes.
double apart_m(const Aabb& a, const Aabb& b) {
  const Vec3 gap = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec3::Zero());
  return gap.head<2>().norm();
}

// Along one axis: against the near wall, against the far one, or a passage away from both.
double place_m(RandomStream& random, double low_m, double high_m, double size_m) {
  const double which = random.uniform();
  const double free = random.uniform(low_m + furniture_gap_m, high_m - furniture_gap_m - size_m);
  if (which < 1.0 / 3.0) {
    return low_m;
  }
  return which < 2.0 / 3.0 ? high_m - size_m : free;
}

Aabb piece_of_furniture(const Aabb& room, RandomStream& random) {
  Vec3 size;
  Vec3 from = Vec3::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    size[axis] = random.uniform(0.4, 1.2);
    from[axis] = place_m(random, room.min[axis], room.max[axis], size[axis]);
  }
  size.z() = random.uniform(0.5, 1.6);
  return {from, from + size};
}

bool holds_coarse_cell(double low_m, double high_m) {
  return (std::ceil(low_m / coarse_m) + 1.0) * coarse_m <= high_m;
}

}  // namespace

double on_wall_grid(double x_m) {
  return std::round(x_m / voxel_m) * voxel_m;
}

double door_centre_m(const BuildingPlan& plan, double wish_m, double low_m, double high_m) {
  const double inside_m = std::clamp(wish_m, low_m, high_m);
  if (!plan.fine_doors) {
    return inside_m;
  }
  const auto voxel_centre = [](double k) { return (k + 0.5) * voxel_m; };
  const double first = std::ceil(low_m / voxel_m - 0.5);
  const double last = std::floor(high_m / voxel_m - 0.5);
  const double nearest = std::clamp(std::floor(inside_m / voxel_m), first, last);
  const double half_m = 0.5 * plan.door_width_m;
  const auto fits = [&](double k) {
    const double centre = voxel_centre(k);
    return k >= first && k <= last && !holds_coarse_cell(centre - half_m, centre + half_m);
  };
  for (int step = 0; step < 16; ++step) {  // 16 voxels are 3 coarse cells: the pattern repeats.
    if (fits(nearest + step)) {
      return voxel_centre(nearest + step);
    }
    if (fits(nearest - step)) {
      return voxel_centre(nearest - step);
    }
  }
  return voxel_centre(nearest);
}

void add_wall(Building& building, const WallStretch& s) {
  building.boxes.push_back(
      upright(s, s.low_m - half_wall_m, s.high_m + half_wall_m, 0.0, ceiling_z_m));
}

void add_wall_with_door(Building& building,
                        const WallStretch& s,
                        BuildingPlan plan,
                        double wish_m,
                        RandomStream& random) {
  if (plan.most_door_width_m > plan.door_width_m) {
    plan.door_width_m =
        door_width_m(plan.door_width_m, plan.most_door_width_m, plan.fine_doors, random);
  }
  const double reach_m = 0.5 * plan.door_width_m + half_wall_m + corner_m;
  const double centre_m = door_centre_m(plan, wish_m, s.low_m + reach_m, s.high_m - reach_m);
  const double left_m = centre_m - 0.5 * plan.door_width_m;
  const double right_m = centre_m + 0.5 * plan.door_width_m;
  building.boxes.push_back(upright(s, s.low_m - half_wall_m, left_m, 0.0, ceiling_z_m));
  building.boxes.push_back(upright(s, right_m, s.high_m + half_wall_m, 0.0, ceiling_z_m));
  building.boxes.push_back(upright(s, left_m, right_m, lintel_z_m, ceiling_z_m));
  building.doors.push_back({upright(s, left_m, right_m, 0.0, lintel_z_m), s.along_y});
}

void furnish(Building& building, const Aabb& room, const BuildingPlan& plan, RandomStream& random) {
  const std::size_t first = building.boxes.size();
  const Aabb goal{plan.keep_clear_W, plan.keep_clear_W};
  const auto fits = [&](const Aabb& piece) {
    const auto is_far = [&](const Aabb& other) { return apart_m(piece, other) >= furniture_gap_m; };
    return is_far(goal) &&
           std::all_of(building.doors.begin(), building.doors.end(),
                       [&](const Doorway& door) { return is_far(door.opening_W); }) &&
           std::all_of(building.boxes.begin() + static_cast<std::ptrdiff_t>(first),
                       building.boxes.end(), is_far);
  };
  const auto wanted = first + static_cast<std::size_t>(plan.furniture_per_room);
  // A full room takes fewer pieces than wished, so tries are bounded.
  for (int i = 0; i < 30 * plan.furniture_per_room && building.boxes.size() < wanted; ++i) {
    const Aabb piece = piece_of_furniture(room, random);
    if (fits(piece)) {
      building.boxes.push_back(piece);
    }
  }
}

void add_ceiling(Building& building) {
  building.extent_W.max.z() = roof_z_m;
  Aabb ceiling = building.extent_W;
  ceiling.min.z() = ceiling_z_m;
  building.boxes.push_back(ceiling);
}

double door_width_m(double least_m, double most_m, bool fine, RandomStream& random) {
  if (!fine) {
    return random.uniform(least_m, most_m);
  }
  const double widths = std::floor((most_m - least_m) / (2.0 * voxel_m) + 1e-9) + 1.0;
  return least_m + 2.0 * voxel_m * std::floor(random.uniform(0.0, widths));
}

Building make_building(const BuildingPlan& plan, RandomStream& random) {
  Building building;
  add_walls_along_y(building, plan, random);
  add_walls_along_x(building, plan, random);
  for (int row = 0; row < plan.rows; ++row) {
    for (int column = 0; column < plan.columns; ++column) {
      const Vec3 low{wall_x_m(plan, row) + half_wall_m, wall_y_m(plan, column) + half_wall_m, 0.0};
      const Vec3 high{wall_x_m(plan, row + 1) - half_wall_m,
                      wall_y_m(plan, column + 1) - half_wall_m, ceiling_z_m};
      furnish(building, {low, high}, plan, random);
    }
  }
  building.extent_W.min = {wall_x_m(plan, 0) - half_wall_m, wall_y_m(plan, 0) - half_wall_m, 0.0};
  building.extent_W.max = {wall_x_m(plan, plan.rows) + half_wall_m,
                           wall_y_m(plan, plan.columns) + half_wall_m, 0.0};
  add_ceiling(building);
  return building;
}

}  // namespace flyball
