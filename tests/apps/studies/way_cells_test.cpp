// SPDX-License-Identifier: BSD-3-Clause

#include "studies/way_cells.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Cylinder body{0.325, 0.125};

World field() {
  World world;
  world.bounds_W = {{0.0, 0.0, 1.0}, {40.0, 30.0, 2.0}};
  return world;
}

/// Across the field at x = 20, with an opening of a width in the middle of it.
World walled(double opening_m) {
  World world = field();
  world.boxes = {{{19.9, -1.0, 0.0}, {20.1, 15.0 - 0.5 * opening_m, 5.0}},
                 {{19.9, 15.0 + 0.5 * opening_m, 0.0}, {20.1, 31.0, 5.0}}};
  return world;
}

WayPrice one_a_metre() {
  return {[](const Aabb&) { return 1.0; }, 1.0};
}

TEST(WayCells, a_way_in_the_open_is_an_under_estimate_and_not_a_bad_one) {
  const WayCells cells{field(), body};
  const WayPrice dear = one_a_metre();
  for (const double angle : {0.0, 0.2, 0.4, 0.6}) {
    const Vec3 from{2.0, 2.0, 0.0};
    const Vec3 to = from + 30.0 * Vec3{std::cos(angle), std::sin(angle), 0.0};
    const auto way = cells.way(from, to, dear);
    ASSERT_TRUE(way);
    EXPECT_LE(way->length_m, 30.0);
    EXPECT_GE(way->length_m, 0.91 * 30.0);
    EXPECT_DOUBLE_EQ(way->cost, way->length_m);
  }
}

TEST(WayCells, a_wall_is_passed_where_it_is_open) {
  const WayCells cells{walled(1.0), body};
  const auto way = cells.way({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, one_a_metre());
  ASSERT_TRUE(way);
  const double straight_m = 2.0 * std::hypot(18.0, 13.0);
  EXPECT_LE(way->length_m, straight_m);
  EXPECT_GE(way->length_m, 0.9 * straight_m);
}

TEST(WayCells, there_is_no_way_through_a_wall) {
  EXPECT_FALSE(WayCells(walled(0.0), body).way({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, one_a_metre()));
}

TEST(WayCells, a_way_over_a_low_wall_counts) {
  World world = walled(0.0);
  for (Aabb& box : world.boxes) {
    box.max.z() = 1.2;
  }
  EXPECT_TRUE(WayCells(world, body).way({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, one_a_metre()));
}

TEST(WayCells, what_cannot_be_gone_round_costs_what_it_costs) {
  const WayCells cells{field(), body};
  const WayPrice price{[](const Aabb& cell_W) {
                         return cell_W.min.x() >= 10.0 && cell_W.max.x() <= 20.0 ? 6.0 : 1.0;
                       },
                       1.0};
  const auto way = cells.way({2.0, 15.0, 0.0}, {38.0, 15.0, 0.0}, price);
  ASSERT_TRUE(way);
  // 26 m at 1 and 10 m at 6; half a cell at both borders may count as cheap.
  EXPECT_LE(way->cost, (26.0 + 60.0) / 1.0823);
  EXPECT_GE(way->cost, (26.0 + 60.0 - 2.0 * 0.25 * 5.0 - 0.5) / 1.0824);
  EXPECT_LE(way->length_m, 36.0);
}

TEST(WayCells, what_costs_more_is_gone_round) {
  const WayCells cells{field(), body};
  const WayPrice price{[](const Aabb& cell_W) {
                         const bool is_inside = cell_W.min.x() >= 10.0 && cell_W.max.x() <= 30.0 &&
                                                cell_W.max.y() <= 10.0;
                         return is_inside ? 10.0 : 1.0;
                       },
                       1.0};
  const auto way = cells.way({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, price);
  ASSERT_TRUE(way);
  const double around_m = 2.0 * std::hypot(8.0, 8.0) + 20.0;
  EXPECT_LE(way->cost, around_m);
  EXPECT_GE(way->cost, 0.9 * around_m);
}

}  // namespace
}  // namespace flyball
