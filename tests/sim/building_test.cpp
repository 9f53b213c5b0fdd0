// SPDX-License-Identifier: BSD-3-Clause
#include "world/building.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

BuildingPlan plan_at(double facade_x_m) {
  BuildingPlan plan;
  plan.facade_x_m = facade_x_m;
  plan.keep_clear_W = {facade_x_m + 30.0, 0.0, 0.0};
  return plan;
}

double apart_m(const Aabb& a, const Aabb& b) {
  const Vec3 gap = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(Vec3::Zero());
  return std::hypot(gap.x(), gap.y());
}

// Furniture is what stands on the ground and does not reach the lintels.
std::vector<Aabb> furniture(const Building& building) {
  std::vector<Aabb> found;
  for (const Aabb& box : building.boxes) {
    if (box.min.z() == 0.0 && box.max.z() < 2.0) {
      found.push_back(box);
    }
  }
  return found;
}

Vec3 origin(const BuildingPlan& plan) {
  return {plan.facade_x_m, -0.5 * plan.columns * plan.room_width_m, 0.0};
}

// Row and column of the room that a piece stands in.
Eigen::Vector2i room_of(const BuildingPlan& plan, const Aabb& piece) {
  const Vec3 inside = 0.5 * (piece.min + piece.max) - origin(plan);
  return {static_cast<int>(inside.x() / plan.room_depth_m),
          static_cast<int>(inside.y() / plan.room_width_m)};
}

bool has_coarse_cell(double low_m, double high_m) {
  for (int k = -50; k < 50; ++k) {
    if (0.8 * k >= low_m && 0.8 * (k + 1) <= high_m) {
      return true;
    }
  }
  return false;
}

TEST(DoorCentre, lies_on_a_fine_voxels_centre_and_leaves_no_coarse_cell_open) {
  BuildingPlan plan;
  for (const double width_m : {0.82, 0.90, 1.1}) {
    plan.door_width_m = width_m;
    for (double wish_m = -8.0; wish_m < 8.0; wish_m += 0.037) {
      const double centre_m = door_centre_m(plan, wish_m, -9.0, 9.0);
      const double voxels = centre_m / 0.15 - 0.5;
      EXPECT_NEAR(voxels, std::round(voxels), 1e-9);
      EXPECT_FALSE(has_coarse_cell(centre_m - 0.5 * width_m, centre_m + 0.5 * width_m));
      EXPECT_NEAR(centre_m, wish_m, 0.6);
    }
  }
}

TEST(DoorCentre, stays_between_its_limits) {
  BuildingPlan plan;
  for (const bool fine : {true, false}) {
    plan.fine_doors = fine;
    EXPECT_GE(door_centre_m(plan, -5.0, -1.0, 1.0), -1.0);
    EXPECT_LE(door_centre_m(plan, 5.0, -1.0, 1.0), 1.0);
  }
  plan.fine_doors = false;
  EXPECT_EQ(door_centre_m(plan, 0.123, -1.0, 1.0), 0.123);
}

TEST(Building, has_a_door_in_each_wall_between_rooms_and_one_entrance) {
  RandomStream random{1, "building_test"};
  const Building building = make_building(plan_at(300.0), random);
  // 4 x 3 rooms: 3 x 3 walls across, 2 x 4 along, and the entrance.
  ASSERT_EQ(building.doors.size(), 18U);
  const Aabb& entrance = building.doors.front().opening_W;
  EXPECT_NEAR(0.5 * (entrance.min.x() + entrance.max.x()), 300.0, 1e-9);
  for (const Doorway& door : building.doors) {
    const int along = door.wall_along_y ? 1 : 0;
    EXPECT_NEAR(door.opening_W.max[along] - door.opening_W.min[along], 0.82, 1e-9);
    EXPECT_GE(door.opening_W.max.z(), 2.1);
  }
}

TEST(Building, draws_the_widths_of_its_doors_and_has_an_exit_where_that_is_asked_for) {
  RandomStream random{4, "building_test"};
  BuildingPlan plan = plan_at(300.0);
  plan.most_door_width_m = 1.6;
  plan.has_exit = true;
  const Building building = make_building(plan, random);
  ASSERT_EQ(building.doors.size(), 19U);
  int exits = 0;
  int wide = 0;
  for (const Doorway& door : building.doors) {
    const int along = door.wall_along_y ? 1 : 0;
    const double width_m = door.opening_W.max[along] - door.opening_W.min[along];
    const double steps = (width_m - 0.82) / 0.30;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
    EXPECT_TRUE(width_m >= 0.82 - 1e-9 && width_m <= 1.6);
    wide += width_m > 0.9 ? 1 : 0;
    exits += door.wall_along_y && door.opening_W.max.x() > 335.0 ? 1 : 0;
  }
  EXPECT_EQ(exits, 1);
  EXPECT_TRUE(wide > 3 && wide < 16);
}

TEST(Building, puts_its_walls_faces_in_the_middle_of_voxels) {
  RandomStream random{2, "building_test"};
  const Building building = make_building(plan_at(300.0), random);
  for (const Doorway& door : building.doors) {
    const int across = door.wall_along_y ? 0 : 1;
    for (const double face_m : {door.opening_W.min[across], door.opening_W.max[across]}) {
      const double voxels = face_m / 0.15 - 0.5;
      EXPECT_NEAR(voxels, std::round(voxels), 1e-6);
    }
  }
}

TEST(Building, keeps_furniture_apart_from_doors_goal_and_itself) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random{seed, "building_test"};
    const BuildingPlan plan = plan_at(150.0);
    const Building building = make_building(plan, random);
    const std::vector<Aabb> pieces = furniture(building);
    EXPECT_GT(pieces.size(), 24U);  // Of 48 wished.
    for (const Aabb& piece : pieces) {
      EXPECT_GE(apart_m(piece, {plan.keep_clear_W, plan.keep_clear_W}), 1.3 - 1e-9);
      for (const Doorway& door : building.doors) {
        EXPECT_GE(apart_m(piece, door.opening_W), 1.3 - 1e-9);
      }
      for (const Aabb& other : pieces) {
        const bool same = piece.min == other.min;
        EXPECT_TRUE(same || apart_m(piece, other) >= 1.3 - 1e-9 ||
                    room_of(plan, piece) != room_of(plan, other));
      }
    }
  }
}

TEST(Building, puts_furniture_against_walls_or_a_passage_away_from_them) {
  RandomStream random{5, "building_test"};
  const BuildingPlan plan = plan_at(150.0);
  int against = 0;
  for (const Aabb& piece : furniture(make_building(plan, random))) {
    const Vec3 pitch{plan.room_depth_m, plan.room_width_m, 1.0};
    for (int axis = 0; axis < 2; ++axis) {
      const double low_m = origin(plan)[axis] + room_of(plan, piece)[axis] * pitch[axis] + 0.075;
      for (const double gap_m :
           {piece.min[axis] - low_m, low_m + pitch[axis] - 0.15 - piece.max[axis]}) {
        against += std::abs(gap_m) < 1e-9 ? 1 : 0;
        EXPECT_TRUE(std::abs(gap_m) < 1e-9 || gap_m >= 1.3 - 1e-9) << gap_m;
      }
    }
  }
  EXPECT_GT(against, 10);
}

TEST(Building, is_covered_by_a_ceiling) {
  RandomStream random{3, "building_test"};
  const Building building = make_building(plan_at(0.0), random);
  const auto covers = [&](const Aabb& box) {
    return box.min.head<2>() == building.extent_W.min.head<2>() &&
           box.max.head<2>() == building.extent_W.max.head<2>() && box.min.z() > 2.1;
  };
  EXPECT_EQ(std::count_if(building.boxes.begin(), building.boxes.end(), covers), 1);
}

}  // namespace
}  // namespace flyball
