// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/world.h"

#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace flyball {
namespace {

constexpr double exact = 1e-12;
const Cylinder body{0.3, 0.2};
const double unlimited = std::numeric_limits<double>::infinity();

World with_box(const Aabb& box) {
  World world;
  world.has_ground = false;
  world.boxes = {box};
  return world;
}

TEST(Clearance, is_the_gap_beside_a_face_above_a_top_and_across_an_edge) {
  const Clearance clearance{with_box({{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}})};
  EXPECT_NEAR(clearance.distance_m({-1.0, 1.0, 1.0}, body, unlimited, true), 0.7, exact);
  EXPECT_NEAR(clearance.distance_m({0.5, 1.0, 4.2}, body, unlimited, true), 1.0, exact);
  EXPECT_NEAR(clearance.distance_m({0.5, 1.0, -1.2}, body, unlimited, true), 1.0, exact);
  // Corner seen from above: 3-4-5. Edge of the top: across .7, up 2.4, so 2.5.
  EXPECT_NEAR(clearance.distance_m({-3.0, -4.0, 1.0}, body, unlimited, true), 4.7, exact);
  EXPECT_NEAR(clearance.distance_m({-1.0, 1.0, 5.6}, body, unlimited, true), 2.5, exact);
}

TEST(Clearance, is_zero_where_the_body_touches_or_overlaps) {
  const Clearance clearance{with_box({{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}})};
  EXPECT_EQ(clearance.distance_m({0.5, 0.5, 0.5}, body, 5.0, true), 0.0);
  EXPECT_EQ(clearance.distance_m({-0.25, 1.0, 1.0}, body, 5.0, true), 0.0);
  // The corner lies inside the body's square but outside its disc.
  EXPECT_GT(clearance.distance_m({-0.25, -0.25, 1.0}, body, 5.0, true), 0.05);
}

TEST(Clearance, to_a_pillar_ends_at_its_top) {
  World world;
  world.has_ground = false;
  world.pillars = {{{2.0, 0.0, 0.0}, 0.5, 3.0}};
  const Clearance clearance{world};
  EXPECT_NEAR(clearance.distance_m({0.0, 0.0, 1.0}, body, unlimited, true), 1.2, exact);
  EXPECT_NEAR(clearance.distance_m({2.0, 0.1, 4.2}, body, unlimited, true), 1.0, exact);
  EXPECT_NEAR(clearance.distance_m({0.5, 0.0, 4.1}, body, unlimited, true), std::hypot(0.7, 0.9),
              exact);
}

TEST(Clearance, counts_the_ground_unless_told_not_to) {
  World world;
  world.ground_z_m = -1.0;
  const Clearance clearance{world};
  EXPECT_NEAR(clearance.distance_m({0.0, 0.0, 0.5}, body, 9.0, false), 1.3, exact);
  EXPECT_EQ(clearance.distance_m({0.0, 0.0, -3.0}, body, 9.0, false), 0.0);
  EXPECT_EQ(clearance.distance_m({0.0, 0.0, 0.5}, body, 9.0, true), 9.0);
}

TEST(Clearance, never_exceeds_the_limit) {
  const Clearance clearance{with_box({{10.0, 0.0, 0.0}, {11.0, 1.0, 1.0}})};
  EXPECT_EQ(clearance.distance_m({0.0, 0.0, 0.5}, body, 2.0, true), 2.0);
  EXPECT_NEAR(clearance.distance_m({0.0, 0.5, 0.5}, body, 20.0, true), 9.7, exact);
}

// What the grid must not change: the smallest of the distances to each solid alone.
double one_by_one(const World& world, const Vec3& p, double limit_m) {
  double best_m = limit_m;
  World single;
  single.has_ground = false;
  for (const Aabb& box : world.boxes) {
    single.boxes = {box};
    best_m = std::min(best_m, Clearance{single}.distance_m(p, body, limit_m, true));
  }
  single.boxes.clear();
  for (const Pillar& pillar : world.pillars) {
    single.pillars = {pillar};
    best_m = std::min(best_m, Clearance{single}.distance_m(p, body, limit_m, true));
  }
  return best_m;
}

Vec3 random_point(RandomStream& random, double half_m, double height_m) {
  const double x = random.uniform(-half_m, half_m);
  const double y = random.uniform(-half_m, half_m);
  return {x, y, random.uniform(0.0, height_m)};
}

TEST(Clearance, is_the_same_with_many_solids_as_with_each_alone) {
  RandomStream random{7, "clearance_test"};
  World world;
  world.has_ground = false;
  for (int i = 0; i < 60; ++i) {
    const Vec3 low = random_point(random, 30.0, 3.0);
    world.boxes.push_back(
        {low, low + random_point(random, 0.0, 4.0) + Vec3{0.5 + 0.1 * i, 1.0, 0.1}});
    world.pillars.push_back({random_point(random, 30.0, 1.0), random.uniform(0.1, 1.0), 4.0});
  }
  const Clearance clearance{world};
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(random, 45.0, 6.0);  // Also well outside the solids' extent.
    const double limit_m = i % 2 == 0 ? 3.0 : 100.0;
    EXPECT_NEAR(clearance.distance_m(p, body, limit_m, true), one_by_one(world, p, limit_m), exact);
  }
}

TEST(Clearance, among_solids_far_apart_takes_no_more_memory_than_a_city) {
  World world;
  world.has_ground = false;
  for (const double at_m : {-9000.0, 9000.0}) {
    world.boxes.push_back({Vec3{at_m, at_m, 0.0}, Vec3{at_m + 1.0, at_m + 1.0, 3.0}});
  }
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const Clearance clearance{world};
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 300'000);  // kB
  const Vec3 p{-8997.0, -8999.5, 1.0};
  EXPECT_NEAR(clearance.distance_m(p, body, 10.0, true), one_by_one(world, p, 10.0), exact);
}

}  // namespace
}  // namespace flyball
