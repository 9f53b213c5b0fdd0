// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"
#include "flyball/sim/worlds.h"

#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Result<World> park(std::uint64_t seed, const std::map<std::string, ParameterValue>& given = {}) {
  Registry registry;
  register_worlds(registry);
  const auto generator = registry.make<WorldGenerator>("park");
  const auto chosen = Parameters::resolve("park", generator->parameters(), given);
  return generator->make(std::get<Parameters>(chosen), seed);
}

MissionTime at_s(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

TEST(Park, has_one_person_who_stands_before_the_start_at_first_and_walks_then) {
  const auto world = park(1);
  ASSERT_EQ(world->people.size(), 1U);
  const Person& person = world->people.front();
  EXPECT_EQ(person.at(at_s(10.0)).foot_W, world->goal_W);
  EXPECT_GT((person.at(at_s(60.0)).foot_W - world->goal_W).norm(), 1.0);
}

TEST(Park, keeps_everything_below_the_height_that_it_declares_open) {
  const auto world = park(2);
  ASSERT_TRUE(world->open_above_m.has_value());
  EXPECT_LT(*world->open_above_m, world->cruise_height_m);
  for (const Aabb& box : world->boxes) {
    EXPECT_LE(box.max.z(), *world->open_above_m);
  }
  for (const Pillar& pillar : world->pillars) {
    EXPECT_LE(pillar.foot_W.z() + pillar.height_m, *world->open_above_m);
  }
}

TEST(Park, leaves_start_and_person_room_and_lets_nobody_walk_through_trunks) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto world = park(seed);
    const Clearance clearance{*world};
    const Vec3 up = 0.5 * Vec3::UnitZ();
    EXPECT_GT(clearance.distance_m(world->start_W + up, {1.0, 0.4}, 5.0, true), 0.5);
    for (double t_s = 0.0; t_s < 200.0; t_s += 0.5) {
      const Vec3 foot_W = world->people.front().at(at_s(t_s)).foot_W;
      ASSERT_TRUE(world->bounds_W.contains({foot_W.x(), foot_W.y(), 1.0}));
      ASSERT_GT(clearance.distance_m(foot_W + up, {0.1, 0.4}, 5.0, true), 0.0) << t_s << " s";
    }
  }
}

TEST(Park, has_as_many_trees_as_asked_for_and_is_the_same_for_a_seed) {
  const auto few = park(3, {{"trees", 5.0}});
  EXPECT_EQ(few->pillars.size(), 10U);  // Trunk and crown.
  EXPECT_EQ(park(3)->pillars.front().foot_W, park(3)->pillars.front().foot_W);
  EXPECT_NE(park(3)->pillars.front().foot_W, park(4)->pillars.front().foot_W);
}

TEST(Park, that_is_too_full_has_as_many_trees_as_find_a_place) {
  const auto world = park(1, {{"size_m", 30.0}, {"trees", 400.0}});
  ASSERT_TRUE(world.ok());
  EXPECT_LT(world->pillars.size(), 800U);
}

}  // namespace
}  // namespace flyball
