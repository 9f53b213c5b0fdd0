// SPDX-License-Identifier: BSD-3-Clause
#include "planning/minimum_snap_knots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace {

using flyball::RoundedPolygon;
using flyball::Vec3;

RoundedPolygon corner(double first_m, double second_m) {
  RoundedPolygon polygon;
  polygon.points_W = {{0, 0, 1}, {first_m, 0, 1}, {first_m, second_m, 1}};
  polygon.limits = {10.0, 3.0};
  polygon.cut_m = flyball::largest_cuts(polygon);
  return polygon;
}

TEST(MinimumSnapKnots, cut_corners_as_far_as_the_shorter_edge_allows) {
  EXPECT_DOUBLE_EQ(corner(100, 100).cut_m[1], 6.0);
  EXPECT_DOUBLE_EQ(corner(100, 4).cut_m[1], 1.8);
  EXPECT_DOUBLE_EQ(corner(4, 100).cut_m[1], 1.8);
  EXPECT_EQ(corner(100, 100).cut_m.front(), 0.0);
  EXPECT_EQ(corner(100, 100).cut_m.back(), 0.0);
}

TEST(MinimumSnapKnots, cut_into_all_of_the_first_edge_where_the_path_comes_straight_on) {
  auto polygon = corner(4, 100);
  polygon.start_velocity_W = {1, 0, 0};
  EXPECT_DOUBLE_EQ(flyball::largest_cuts(polygon)[1], 3.6);
}

TEST(MinimumSnapKnots, stop_where_a_curve_would_be_too_tight_or_turn_back) {
  EXPECT_EQ(corner(100, 0.4).cut_m[1], 0.0);
  auto back = corner(100, 100);
  back.points_W[2] = {0, 1, 1};
  EXPECT_EQ(flyball::largest_cuts(back)[1], 0.0);
  back.cut_m = flyball::largest_cuts(back);
  const auto knots = flyball::knots_of(back);
  EXPECT_TRUE(std::all_of(knots.corner.begin(), knots.corner.end(), [](int c) { return c < 0; }));
  EXPECT_TRUE(std::any_of(knots.knots.begin() + 1, knots.knots.end() - 1, [&](const auto& knot) {
    return knot.p_W == back.points_W[1] && knot.along == Vec3::Zero() && knot.is_fixed;
  }));
}

TEST(MinimumSnapKnots, shrink_to_nothing_in_the_end) {
  auto polygon = corner(100, 100);
  int steps = 0;
  while (polygon.cut_m[1] > 0.0) {
    const double smaller = flyball::smaller_cut(polygon, 1);
    ASSERT_LT(smaller, polygon.cut_m[1]);
    polygon.cut_m[1] = smaller;
    ++steps;
  }
  EXPECT_GE(steps, 4);
  EXPECT_LE(steps, 12);
}

TEST(MinimumSnapKnots, lie_on_the_polygon_in_order_with_trapezoidal_durations) {
  const auto polygon = corner(100, 50);
  const auto result = flyball::knots_of(polygon);
  ASSERT_EQ(result.knots.size(), result.durations_s.size() + 1);
  ASSERT_EQ(result.corner.size(), result.durations_s.size());
  EXPECT_EQ(result.knots.front().p_W, polygon.points_W.front());
  EXPECT_EQ(result.knots.back().p_W, polygon.points_W.back());
  double last = -1.0;
  for (const auto& knot : result.knots) {
    EXPECT_TRUE(knot.p_W.y() == 0.0 || knot.p_W.x() == 100.0);
    EXPECT_GT(knot.p_W.x() + knot.p_W.y(), last);
    EXPECT_LE(knot.along[0], polygon.limits.max_speed_m_s);
    last = knot.p_W.x() + knot.p_W.y();
  }
  EXPECT_EQ(std::count(result.corner.begin(), result.corner.end(), 1), 1);
  // 150 m with half of 3 m/s^2 for speed: 100 m in no less than 2 sqrt(100 / 1.5) = 16 s.
  const double total_s = std::accumulate(result.durations_s.begin(), result.durations_s.end(), 0.0);
  EXPECT_GT(total_s, 20.0);
  EXPECT_LT(total_s, 35.0);
}

TEST(MinimumSnapKnots, bend_in_from_the_start_velocity) {
  auto polygon = corner(100, 100);
  polygon.start_velocity_W = {2, 2, 0};
  polygon.cut_m = flyball::largest_cuts(polygon);
  EXPECT_GT(polygon.cut_m[0], 1.0);
  const auto result = flyball::knots_of(polygon);
  EXPECT_EQ(result.corner.front(), 0);
  EXPECT_LT((result.knots[0].direction_W - Vec3{1, 1, 0}.normalized()).norm(), 1e-12);
  EXPECT_GT(result.knots[0].along[0], 0.5);
  EXPECT_EQ(result.knots[1].direction_W, Vec3::UnitX());
}

TEST(MinimumSnapKnots, turn_more_widely_behind_a_piece_straight_ahead) {
  for (const double turn : {0.05, 0.2, 0.5, 1.0}) {
    auto polygon = corner(20, 20);
    polygon.start_velocity_W = {std::cos(turn), std::sin(turn), 0.0};
    const auto places_W = flyball::lead_ins_W(polygon);
    ASSERT_FALSE(places_W.empty()) << turn;
    double last_m = std::numeric_limits<double>::infinity();
    for (const Vec3& place : places_W) {
      auto with = polygon;
      with.points_W.insert(with.points_W.begin() + 1, place);
      with.cut_m = flyball::largest_cuts(with);
      EXPECT_EQ(with.cut_m[0], 0.0);
      const double radius_m = flyball::curve_radius_m(with, 1);
      EXPECT_GT(radius_m, flyball::widest_bend_m(polygon)) << turn;
      const double useful_m = std::min(radius_m, 10.0 * 10.0 / (0.55 * 3.0));
      EXPECT_LE(useful_m, last_m) << turn;
      last_m = useful_m;
    }
  }
  auto straight = corner(20, 20);
  straight.start_velocity_W = {1.0, 0.0, 0.0};
  EXPECT_TRUE(flyball::lead_ins_W(straight).empty());
  straight.start_velocity_W = {-1.0, 0.1, 0.0};  // It would have to turn back.
  EXPECT_TRUE(flyball::lead_ins_W(straight).empty());
}

}  // namespace
