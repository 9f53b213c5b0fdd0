// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan.h"
#include "made_world.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double body_and_tube_m = 0.355;  // Half of .65 m, and .03 m.

FloorPlan floor_of(const World& world, double resolution_m) {
  return {world, resolution_m, 1.4, 1.6};
}

TEST(Mixed, can_be_crossed_with_the_fine_map_for_any_seed) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const auto world = made_world("mixed", seed);
    ASSERT_TRUE(world) << world.error().message;
    const double length_m = world->goal_W.x();
    EXPECT_TRUE(length_m >= 600.0 && length_m <= 1200.0);
    EXPECT_TRUE(floor_of(*world, 0.15).connects(world->start_W, world->goal_W, body_and_tube_m))
        << "seed " << seed;
  }
}

TEST(Mixed, cannot_be_crossed_where_a_building_is_shut) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto world = made_world("mixed", seed, {{"buildings", 1.0}, {"slits", -1.0}});
    ASSERT_TRUE(world) << world.error().message;
    World shut = *world;
    const Aabb& indoors = shut.zones.front().box_W;
    shut.boxes.push_back(
        {{indoors.min.x() + 1.5, -15.375, 0.0}, {indoors.min.x() + 1.7, 15.375, 3.0}});
    EXPECT_FALSE(floor_of(shut, 0.15).connects(shut.start_W, shut.goal_W, body_and_tube_m));
  }
}

TEST(Mixed, closes_for_coarse_cells_what_is_narrow) {
  int shut = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto world = made_world("mixed", seed);
    shut += floor_of(*world, 0.6).connects(world->start_W, world->goal_W, body_and_tube_m) ? 0 : 1;
  }
  EXPECT_EQ(shut, 10);
}

TEST(Mixed, has_as_many_things_as_asked_for) {
  const auto world = made_world(
      "mixed", 3, {{"buildings", 3.0}, {"crowds", 1.0}, {"slits", 2.0}, {"length_m", 900.0}});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_EQ(world->zones.size(), 3U);
  EXPECT_EQ(world->goal_W.x(), 900.0);
  int halves = 0;
  for (const Aabb& box : world->boxes) {
    halves += std::abs(box.max.x() - box.min.x() - 3.0) < 1e-9 ? 1 : 0;
  }
  EXPECT_EQ(halves, 4);
}

TEST(Mixed, says_how_long_it_must_be) {
  const auto world = made_world("mixed", 1, {{"length_m", 100.0}, {"buildings", 2.0}});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().code, ErrorCode::invalid_input);
  EXPECT_NE(world.error().message.find("length_m = 100"), std::string::npos);
}

}  // namespace
}  // namespace flyball
