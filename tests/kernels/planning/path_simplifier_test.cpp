// SPDX-License-Identifier: BSD-3-Clause
#include "planning/path_simplifier.h"

#include "plan_scenes.h"
#include <cmath>

#include <gtest/gtest.h>

namespace {

using flyball::CellState;
using flyball::MotionChecker;
using flyball::PlanRequest;
using flyball::Vec3;
using flyball::kit::GridMap;

using Polygon = std::vector<Vec3>;

constexpr double far_m = 1000.0;
const flyball::Aabb everywhere{{-far_m, -far_m, -far_m}, {far_m, far_m, far_m}};

Polygon simplified(const GridMap& map,
                   const Polygon& points,
                   const flyball::Aabb& bounds_W = everywhere,
                   const std::vector<flyball::Aabb>& slow_W = {}) {
  PlanRequest request;
  request.bounds_W = bounds_W;
  request.slow_W = slow_W;
  request.seed = 1;
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  Polygon result = flyball::simplify(points, checker, request);
  EXPECT_EQ(result.front(), points.front());
  EXPECT_EQ(result.back(), points.back());
  for (std::size_t i = 0; i + 1 < result.size(); ++i) {
    EXPECT_TRUE(checker.is_flyable(result[i], result[i + 1])) << i;
  }
  return result;
}

double length_m(const Polygon& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    sum += (points[i] - points[i - 1]).norm();
  }
  return sum;
}

TEST(PathSimplifier, leaves_a_straight_line_of_a_zigzag_in_the_open) {
  const GridMap map{{{0, -6, 0}, {24, 6, 3}}, 0.15};
  Polygon zigzag;
  for (int i = 0; i < 20; ++i) {
    zigzag.push_back({1.0 + i, i % 2 == 0 ? 0.0 : 1.5, 1.5});
  }
  EXPECT_EQ(simplified(map, zigzag).size(), 2U);
}

TEST(PathSimplifier, goes_round_a_block_with_room_to_spare) {
  GridMap map{{{0, -8, 0}, {24, 8, 3}}, 0.15};
  map.fill({{9, -3, 0}, {12, 3, 3}}, CellState::occupied);
  const Polygon detour{{2, 0, 1.5}, {4, 7, 1.5}, {17, 7, 1.5}, {20, 0, 1.5}};
  const Polygon result = simplified(map, detour);
  EXPECT_LT(length_m(result), 0.95 * length_m(detour));
  EXPECT_LE(result.size(), 5U);
  for (std::size_t i = 1; i + 1 < result.size(); ++i) {
    EXPECT_GT(map.nearest_obstacle_m(result[i], 2.0, 0.2), 0.5) << result[i].transpose();
  }
}

// Around a corner of a room, and past a wall behind it.
TEST(PathSimplifier, lengthens_no_path_for_room_where_the_vehicle_is_slow) {
  GridMap map{{{0, 0, 0}, {9, 9, 3}}, 0.15};
  map.fill({{0, 0, 0}, {4.5, 4.5, 3}}, CellState::occupied);
  map.fill({{6, 5.4, 0}, {9, 5.7, 3}}, CellState::occupied);
  const Polygon around{{1, 5, 1.5}, {5, 5, 1.5}, {5, 1, 1.5}};
  const flyball::Aabb beside{{6, 0, 0}, {9, 9, 3}};
  EXPECT_LT(length_m(simplified(map, around, everywhere, {everywhere})), length_m(around));
  EXPECT_GT(length_m(simplified(map, around, everywhere, {beside})), length_m(around));
}

TEST(PathSimplifier, moves_nothing_out_of_bounds) {
  GridMap map{{{0, -8, 0}, {24, 8, 3}}, 0.15};
  map.fill({{9, -3, 0}, {12, 3, 3}}, CellState::occupied);
  const flyball::Aabb bounds_W{{0, -3.6, 0}, {24, 3.6, 3}};
  const Polygon detour{{2, 0, 1.5}, {8.5, 3.5, 1.5}, {12.5, 3.5, 1.5}, {20, 0, 1.5}};
  for (const Vec3& point : simplified(map, detour, bounds_W)) {
    EXPECT_TRUE(bounds_W.contains(point)) << point.transpose();
  }
}

TEST(PathSimplifier, merges_points_that_lie_close_together) {
  GridMap map{{{0, -8, 0}, {24, 8, 3}}, 0.15};
  map.fill({{9, -8, 0}, {12, 3, 3}}, CellState::occupied);
  const Polygon corner{{2, 0, 1.5},    {8, 5, 1.5},  {8.05, 5.02, 1.5}, {8.1, 5.05, 1.5},
                       {12, 5.1, 1.5}, {20, 0, 1.5}, {20.1, 0, 1.5}};
  const Polygon result = simplified(map, corner);
  for (std::size_t i = 0; i + 1 < result.size(); ++i) {
    EXPECT_GT((result[i + 1] - result[i]).norm(), 0.2);
  }
}

TEST(PathSimplifier, gives_the_same_for_the_same_stream) {
  const auto scene = flyball::kit::random_world(3);
  const Polygon open{scene.request.start_W, {1, -7, 1.5}, {12, -7.4, 1.5}, scene.request.goal_W};
  MotionChecker checker{scene.map, {0.1, 0.1}, 1.5};
  PlanRequest request;
  request.bounds_W = everywhere;
  request.seed = 9;
  const auto run = [&] { return flyball::simplify(open, checker, request); };
  EXPECT_EQ(run(), run());
}

}  // namespace
