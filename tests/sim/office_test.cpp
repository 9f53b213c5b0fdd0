// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/sim/worlds.h"

#include "made_world.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double body_and_tube_m = 0.355;  // Half of .65 m, and .03 m.

TEST(Office, starts_inside_the_volume_that_is_to_be_mapped) {
  const auto world = made_world("office", 1);
  ASSERT_TRUE(world) << world.error().message;
  const Vec3 above = world->start_W + Vec3{0.0, 0.0, world->cruise_height_m};
  EXPECT_TRUE(world->volume_W.contains(above));
  EXPECT_TRUE(world->bounds_W.contains(above));
  EXPECT_GT((world->volume_W.max - world->volume_W.min).prod(), 400.0);
}

TEST(Office, has_a_room_behind_each_door_into_which_the_body_fits) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto world = made_world("office", seed, {{"furniture_per_room", 0.0}});
    ASSERT_TRUE(world);
    const Clearance clearance{*world};
    const Cylinder body{body_and_tube_m, 0.155};
    for (const double wall_m : {-1.2, 1.2}) {
      int doors = 0;
      bool was_open = false;
      for (double x_m = 0.075; x_m < 15.3; x_m += 0.01) {
        const bool is_open = clearance.distance_m({x_m, wall_m, 1.2}, body, 0.1, true) > 0.0;
        doors += is_open && !was_open ? 1 : 0;
        was_open = is_open;
      }
      EXPECT_EQ(doors, 3) << "seed " << seed;
    }
  }
}

TEST(Office, grows_with_its_rooms) {
  const auto small = made_world("office", 1, {{"rooms_per_side", 1.0}});
  const auto large = made_world("office", 1, {{"rooms_per_side", 4.0}});
  ASSERT_TRUE(small && large);
  EXPECT_NEAR(large->volume_W.max.x() - small->volume_W.max.x(), 3 * 5.1, 1e-9);
  EXPECT_GT(large->boxes.size(), small->boxes.size());
}

TEST(Office, delivers_to_the_room_that_is_named_and_keeps_its_middle_clear) {
  for (int room = 1; room <= 6; ++room) {
    const auto world = made_world(
        "office", 3, {{"goal_room", static_cast<double>(room)}, {"furniture_per_room", 10.0}});
    ASSERT_TRUE(world) << world.error().message;
    EXPECT_EQ(world->goal_W.y() < -1.2, room % 2 == 1) << "odd rooms lie south";
    EXPECT_NEAR(world->goal_W.x(), 5.1 * ((room - 1) / 2 + 0.5), 1e-9);
    const Vec3 middle = world->goal_W + Vec3{0.0, 0.0, 1.25};
    EXPECT_GT(Clearance{*world}.distance_m(middle, {world->goal_clear_m, 1.2}, 0.1, true), 0.0);
  }
}

TEST(Office, refuses_a_goal_in_a_room_that_there_is_not) {
  const auto world = made_world("office", 1, {{"rooms_per_side", 2.0}, {"goal_room", 5.0}});
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().message.find("not among the 4 rooms"), std::string::npos)
      << world.error().message;
}

TEST(Office, says_how_near_the_walls_of_a_narrow_corridor_are) {
  for (const double width_m : {1.8, 2.1, 2.4, 4.0}) {
    const auto world = made_world("office", 1, {{"corridor_width_m", width_m}});
    ASSERT_TRUE(world);
    EXPECT_LE(world->start_clear_m, 1.0);
    const Clearance clearance{*world};
    const Cylinder promised{world->start_clear_m - 1e-6, 1.25};
    EXPECT_GT(clearance.distance_m(world->start_W + Vec3{0, 0, 1.25}, promised, 2.0, true), 0.0)
        << width_m;
    EXPECT_EQ(world->goal_clear_m, world->start_clear_m) << "they are one place";
  }
  EXPECT_EQ(made_world("office", 1)->start_clear_m, 1.0);
}

}  // namespace
}  // namespace flyball
