// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/observable_space.h"
#include "flyball/sim/worlds.h"

#include "made_world.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

ObservableRequest request_in(const World& world) {
  ObservableRequest request;
  request.body = {0.355, 0.155};
  request.start_W = world.start_W + Vec3::UnitZ() * world.cruise_height_m;
  request.camera.width_px = 64;
  request.camera.height_px = 36;
  request.cell_m = 0.3;
  return request;
}

TEST(CollapsedBuilding, has_one_person_inside_with_nothing_upon_it) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto world = made_world("collapsed_building", seed);
    ASSERT_TRUE(world) << world.error().message;
    ASSERT_EQ(world->people.size(), 1U);
    const Vec3 foot_W = world->people.front().at(MissionTime{}).foot_W;
    EXPECT_TRUE(world->volume_W.contains(foot_W));
    EXPECT_GT((foot_W - world->start_W).norm(), 6.0);
    const Clearance clearance{*world};
    EXPECT_GT(clearance.distance_m(foot_W + Vec3{0, 0, 0.9}, {0.5, 0.85}, 1.0, true), 0.0)
        << "seed " << seed;
  }
}

TEST(CollapsedBuilding, has_room_for_a_person_who_lies) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto world = made_world("collapsed_building", seed, {{"person", std::string{"lying"}}});
    ASSERT_TRUE(world) << world.error().message;
    const Person& person = world->people.front();
    EXPECT_TRUE(person.lies);
    EXPECT_LT(person.height_m, 0.35);
    EXPECT_DOUBLE_EQ(2.0 * person.radius_m, Person{}.height_m)
        << "as long as one who stands is tall";
    const Clearance clearance{*world};
    EXPECT_GT(clearance.distance_m(person.centre_W({}), {person.radius_m, 0.1}, 1.0, true), 0.0)
        << "seed " << seed;
    const Cylinder vehicle{0.325, 0.125};
    const Vec3 above_W = person.centre_W({}) + Vec3::UnitZ();
    EXPECT_NEAR(distance_to_people_m(world->people, {}, above_W, vehicle, 5.0), 0.72, 1e-9)
        << "it may be flown over";
  }
}

TEST(CollapsedBuilding, has_slabs_and_rubble_but_keeps_the_start_clear) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto world = made_world("collapsed_building", seed);
    const auto bare = made_world("collapsed_building", seed, {{"slabs", 0.0}, {"rubble", 0.0}});
    ASSERT_TRUE(world && bare);
    EXPECT_GT(world->boxes.size(), bare->boxes.size() + 20);
    const Clearance clearance{*world};
    EXPECT_GT(clearance.distance_m(world->start_W + Vec3{0, 0, 1.25}, {1.0, 1.25}, 2.0, true), 0.0);
  }
}

TEST(CollapsedBuilding, lets_the_body_come_to_where_it_sees_the_person) {
  const auto world =
      made_world("collapsed_building", 1, {{"length_m", 9.0}, {"width_m", 6.0}, {"walls", 1.0}});
  ASSERT_TRUE(world);
  const ObservableSpace space = observable_space(*world, request_in(*world));
  const GridCell beside = grid_cell_of(
      world->people.front().at(MissionTime{}).foot_W + Vec3{0.0, 0.5, 1.2}, space.cell_m);
  EXPECT_NE(std::find(space.cells.begin(), space.cells.end(), beside), space.cells.end());
}

TEST(CollapsedBuilding, refuses_walls_that_leave_no_room_for_start_and_person) {
  for (const double length_m : {9.0, 15.0, 20.0}) {
    for (double walls = 1.0; walls <= 8.0; walls += 1.0) {
      const auto world = made_world("collapsed_building", 1,
                                    {{"length_m", length_m}, {"walls", walls}, {"slabs", 0.0}});
      const double bay_m = length_m / (walls + 1.0);
      EXPECT_EQ(world.ok(), bay_m > 2.6) << length_m << " m, " << walls << " walls";
      if (world) {
        const Clearance clearance{*world};
        EXPECT_GT(clearance.distance_m(world->start_W + Vec3{0, 0, 1.25}, {1.0, 1.25}, 2.0, true),
                  0.0);
      } else {
        EXPECT_NE(world.error().message.find("have at most "), std::string::npos)
            << world.error().message;
      }
    }
  }
}

}  // namespace
}  // namespace flyball
