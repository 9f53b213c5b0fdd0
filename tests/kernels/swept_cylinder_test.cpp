// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/collision_check.h"
#include "flyball/kernels/kernels.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include "grid_map.h"
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace {

using flyball::CellState;
using flyball::Path;
using flyball::PathCheck;
using flyball::Vec3;
using flyball::Work;
using flyball::kit::GridMap;

constexpr flyball::Cylinder body{0.355, 0.13};

PathCheck checked(
    const GridMap& map, const Path& path, double from_m, double horizon_m, Work& work) {
  flyball::Registry registry;
  flyball::register_kernels(registry);
  const auto checker = registry.make<flyball::CollisionChecker>("swept_cylinder");
  return checker->check(map, {&path, from_m, horizon_m}, body, work);
}

TEST(SweptCylinder, finds_where_the_body_first_touches_a_wall) {
  GridMap map{{{0, -3, 0}, {60, 3, 3}}, 0.15};
  const Path path = Path::polyline({{1, 0, 1.5}, {59, 0, 1.5}});
  Work work;
  EXPECT_FALSE(checked(map, path, 0.0, 10.0, work).blocked_at_m);
  map.fill({{45, -3, 0}, {45.15, 3, 3}}, CellState::occupied);
  const PathCheck check = checked(map, path, 0.0, 10.0, work);
  ASSERT_TRUE(check.blocked_at_m);
  const double contact_m = 45.0 - 1.0 - body.radius_m;
  EXPECT_LE(*check.blocked_at_m, contact_m + 1e-9);
  EXPECT_GE(*check.blocked_at_m, contact_m - 0.011);
}

TEST(SweptCylinder, misses_nothing_that_is_thinner_than_its_steps) {
  GridMap map{{{32, -1, 1}, {34, 1, 2}}, 0.01};
  map.fill({{33.30, 0.30, 1.4}, {33.31, 0.35, 1.6}}, CellState::occupied);  // a wire end
  const Path path = Path::polyline({{1, 0, 1.5}, {59, 0, 1.5}}, 1.0);
  Work work;
  const PathCheck check = checked(map, path, 0.0, 0.0, work);
  ASSERT_TRUE(check.blocked_at_m);
  EXPECT_NEAR(*check.blocked_at_m, 32.3 - std::sqrt(0.355 * 0.355 - 0.30 * 0.30), 0.02);
}

TEST(SweptCylinder, looks_only_ahead) {
  GridMap map{{{0, -3, 0}, {60, 3, 3}}, 0.15};
  map.fill({{10, -3, 0}, {10.15, 3, 3}}, CellState::occupied);
  const Path path = Path::polyline({{1, 0, 1.5}, {59, 0, 1.5}});
  Work work;
  EXPECT_TRUE(checked(map, path, 5.0, 1.0, work).blocked_at_m);
  EXPECT_FALSE(checked(map, path, 12.0, 1.0, work).blocked_at_m);
  EXPECT_FALSE(checked(map, path, path.length_m(), 1.0, work).blocked_at_m);
  const PathCheck inside = checked(map, path, 9.05, 1.0, work);
  ASSERT_TRUE(inside.blocked_at_m);
  EXPECT_NEAR(*inside.blocked_at_m, 9.05, 1e-9);
}

TEST(SweptCylinder, ends_known_free_space_at_the_first_unknown_cell) {
  GridMap map{{{0, -3, 0}, {60, 3, 3}}, 0.15};
  map.fill({{20.1, -3, 0}, {60, 3, 3}}, CellState::unknown);
  const Path path = Path::polyline({{1, 0, 1.5}, {59, 0, 1.5}});
  Work work;
  const PathCheck check = checked(map, path, 2.0, 30.0, work);
  EXPECT_FALSE(check.blocked_at_m) << "unknown is not occupied";
  EXPECT_NEAR(check.known_free_m, 20.1 - 3.0 - body.radius_m, 0.06);
  EXPECT_NEAR(checked(map, path, 2.0, 5.0, work).known_free_m, 5.0, 1e-9);
}

TEST(SweptCylinder, counts_the_poses_that_it_covers) {
  const GridMap map{{{0, -3, 0}, {60, 3, 3}}, 0.15};
  const Path path = Path::polyline({{1, 0, 1.5}, {59, 0, 1.5}});
  Work near;
  Work far;
  (void)checked(map, path, 50.0, 1.0, near);
  (void)checked(map, path, 0.0, 10.0, far);
  EXPECT_NEAR(near.count("poses"), (8.0 + 1.0) / 0.05 + 2.0, 2.0);
  EXPECT_NEAR(far.count("poses"), (58.0 + 10.0) / 0.05 + 2.0, 2.0);
}

TEST(SweptCylinder, agrees_with_every_chord_on_curves_among_random_obstacles) {
  int blocked = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    flyball::RandomStream random{seed, "swept"};
    GridMap map{{{-12, -12, 0}, {12, 12, 3}}, 0.15};
    for (int i = 0; i < 8; ++i) {
      const Vec3 foot{random.uniform(-11, 11), random.uniform(-11, 11), 0.0};
      map.fill({foot, foot + Vec3{0.5, 0.5, 3.0}}, CellState::occupied);
    }
    std::vector<Vec3> circle;
    const double radius_m = random.uniform(1.0, 10.0);
    for (int i = 0; i <= 200; ++i) {
      const double angle = 0.03 * i;
      circle.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle), 1.5});
    }
    const Path path = Path::polyline(circle);
    Work work;
    const PathCheck check = checked(map, path, 0.0, 0.0, work);
    double first_m = path.length_m();
    const auto& samples = path.samples();
    for (std::size_t i = 0; i + 1 < samples.size() && first_m == path.length_m(); ++i) {
      if (map.segment_hits(samples[i].p_W, samples[i + 1].p_W, body)) {
        first_m = samples[i].s_m;
      }
    }
    EXPECT_NEAR(check.blocked_at_m.value_or(path.length_m()), first_m, 0.07) << seed;
    blocked += check.blocked_at_m ? 1 : 0;
  }
  EXPECT_GT(blocked, 5);
  EXPECT_LT(blocked, 30);
}

TEST(SweptCylinder, has_nothing_to_say_about_no_path) {
  const GridMap map{{{0, 0, 0}, {1, 1, 1}}, 0.15};
  Work work;
  const PathCheck check = checked(map, Path{}, 0.0, 5.0, work);
  EXPECT_FALSE(check.blocked_at_m);
  EXPECT_EQ(check.known_free_m, 0.0);
  EXPECT_EQ(work.count("poses"), 0.0);
}

}  // namespace
