// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
// The world of the paper's two-resolution case: open on a .15 m map, shut on a .80 m one.
#include "floor_plan.h"
#include "made_world.h"
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double body_m = 0.325;           // Half of the Matrice's .65 m.
constexpr double body_and_tube_m = 0.355;  // And the indoor tracking tube of .03 m.
constexpr std::uint64_t seeds = 20;

World made(std::uint64_t seed, const std::map<std::string, ParameterValue>& given = {}) {
  return made_world("outdoor_to_indoor", seed, given).value();
}

// At the body's height over cruise, with a margin above and below.
FloorPlan cut(const World& world, double resolution_m) {
  return {world, resolution_m, 0.9, 1.5};
}

TEST(OutdoorToIndoor, lets_the_vehicle_through_on_a_map_of_15_cm) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const World world = made(seed);
    EXPECT_TRUE(cut(world, 0.15).connects(world.start_W, world.goal_W, body_and_tube_m))
        << "seed " << seed;
  }
}

TEST(OutdoorToIndoor, is_shut_on_a_map_of_80_cm_but_only_at_the_building) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const World world = made(seed);
    const FloorPlan plan = cut(world, 0.80);
    EXPECT_FALSE(plan.connects(world.start_W, world.goal_W, body_m)) << "seed " << seed;
    const Vec3 before_facade{world.zones.front().box_W.min.x() - 1.0, 0.0, 0.0};
    EXPECT_TRUE(plan.connects(world.start_W, before_facade, body_m)) << "seed " << seed;
  }
}

TEST(OutdoorToIndoor, with_random_doors_is_often_shut_on_a_map_of_15_cm) {
  int open = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const World world = made(seed, {{"door_alignment", "random"}, {"outdoors_m", 30.0}});
    open += cut(world, 0.15).connects(world.start_W, world.goal_W, body_and_tube_m) ? 1 : 0;
  }
  // One door is open in 47 % of the alignments, and the entrance has no way around it.
  EXPECT_GT(open, 0);
  EXPECT_LT(open, 15);
}

TEST(OutdoorToIndoor, has_no_other_opening_than_the_entrance) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    World world = made(seed, {{"outdoors_m", 30.0}});
    // A plug in the entrance: the facade's wall over its whole width.
    world.boxes.push_back({{29.925, -15.0, 0.0}, {30.075, 15.0, 3.0}});
    EXPECT_FALSE(cut(world, 0.05).connects(world.start_W, world.goal_W, 0.01)) << "seed " << seed;
  }
}

TEST(OutdoorToIndoor, keeps_its_blocks_away_from_start_and_facade_and_above_the_ceiling) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const World world = made(seed);
    const double facade_m = 299.925;
    int blocks = 0;
    for (const Aabb& box : world.boxes) {
      if (box.max.x() < facade_m - 0.5) {
        ++blocks;
        EXPECT_LE(box.max.x(), facade_m - 5.9);
        EXPECT_GE(world.start_W.cwiseMax(box.min).cwiseMin(box.max).norm(), 6.0);
        EXPECT_GT(box.max.z(), world.bounds_W.max.z() + 1.0);
      }
    }
    EXPECT_GE(blocks, 25);  // 12 x 3 cells of 25 m, less those too near to start and facade.
    EXPECT_LE(blocks, 36);
  }
}

// Free width at 1.2 m height, measured along y from the middle of the entrance.
double gap_along_y_m(const World& world, const Vec3& p) {
  double left_m = 1e9;
  double right_m = 1e9;
  for (const Aabb& box : world.boxes) {
    const bool beside =
        box.min.x() <= p.x() && p.x() <= box.max.x() && box.min.z() <= 1.2 && box.max.z() >= 1.2;
    if (beside && box.max.y() <= p.y()) {
      left_m = std::min(left_m, p.y() - box.max.y());
    } else if (beside && box.min.y() >= p.y()) {
      right_m = std::min(right_m, box.min.y() - p.y());
    }
  }
  return left_m + right_m;
}

TEST(OutdoorToIndoor, has_one_entrance_of_the_width_asked_for) {
  const World world = made(4, {{"outdoors_m", 30.0}});
  const Clearance clearance{world};
  int middle_points = 0;
  for (double y = -4.5; y < 4.5; y += 0.01) {
    const Vec3 in_the_wall{30.0, y, 1.2};
    if (clearance.distance_m(in_the_wall, {0.0, 0.1}, 1.0, false) > 0.0) {
      EXPECT_NEAR(gap_along_y_m(world, in_the_wall), 0.82, 1e-9);
      ++middle_points;
    }
  }
  EXPECT_NEAR(middle_points, 82, 1);
}

TEST(OutdoorToIndoor, limits_the_speed_in_and_around_the_building) {
  const World world = made(1);
  ASSERT_EQ(world.zones.size(), 1U);
  EXPECT_EQ(world.zones[0].max_speed_m_s, 1.0);
  EXPECT_NEAR(world.zones[0].box_W.min.x(), 300.0 - 0.075 - 1.5, 1e-9);
  EXPECT_TRUE(world.zones[0].box_W.contains(world.goal_W));
  EXPECT_NEAR(world.goal_W.x(), 330.0, 1e-9);
}

}  // namespace
}  // namespace flyball
