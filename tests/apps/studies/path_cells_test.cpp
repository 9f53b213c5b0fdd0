// SPDX-License-Identifier: BSD-3-Clause

#include "studies/path_cells.h"

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

PathPrice one_a_metre() {
  return {[](const Aabb&) { return 1.0; }, 1.0};
}

TEST(PathCells, a_path_in_the_open_is_an_under_estimate_and_not_a_bad_one) {
  const PathCells cells{field(), body};
  const PathPrice dear = one_a_metre();
  for (const double angle : {0.0, 0.2, 0.4, 0.6}) {
    const Vec3 from{2.0, 2.0, 0.0};
    const Vec3 to = from + 30.0 * Vec3{std::cos(angle), std::sin(angle), 0.0};
    const auto path = cells.path(from, to, dear);
    ASSERT_TRUE(path);
    EXPECT_LE(path->length_m, 30.0);
    EXPECT_GE(path->length_m, 0.91 * 30.0);
    EXPECT_DOUBLE_EQ(path->cost, path->length_m);
  }
}

TEST(PathCells, a_wall_is_passed_where_it_is_open) {
  const PathCells cells{walled(1.0), body};
  const auto path = cells.path({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, one_a_metre());
  ASSERT_TRUE(path);
  const double straight_m = 2.0 * std::hypot(18.0, 13.0);
  EXPECT_LE(path->length_m, straight_m);
  EXPECT_GE(path->length_m, 0.9 * straight_m);
}

TEST(PathCells, there_is_no_path_through_a_wall) {
  EXPECT_FALSE(PathCells(walled(0.0), body).path({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, one_a_metre()));
}

TEST(PathCells, a_path_over_a_low_wall_counts) {
  World world = walled(0.0);
  for (Aabb& box : world.boxes) {
    box.max.z() = 1.2;
  }
  EXPECT_TRUE(PathCells(world, body).path({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, one_a_metre()));
}

TEST(PathCells, what_cannot_be_gone_round_costs_what_it_costs) {
  const PathCells cells{field(), body};
  const PathPrice price{[](const Aabb& cell_W) {
                          return cell_W.min.x() >= 10.0 && cell_W.max.x() <= 20.0 ? 6.0 : 1.0;
                        },
                        1.0};
  const auto path = cells.path({2.0, 15.0, 0.0}, {38.0, 15.0, 0.0}, price);
  ASSERT_TRUE(path);
  // 26 m at 1 and 10 m at 6; half a cell at both borders may count as cheap.
  EXPECT_LE(path->cost, (26.0 + 60.0) / 1.0823);
  EXPECT_GE(path->cost, (26.0 + 60.0 - 2.0 * 0.25 * 5.0 - 0.5) / 1.0824);
  EXPECT_LE(path->length_m, 36.0);
}

TEST(PathCells, what_costs_more_is_gone_round) {
  const PathCells cells{field(), body};
  const PathPrice price{[](const Aabb& cell_W) {
                          const bool is_inside = cell_W.min.x() >= 10.0 && cell_W.max.x() <= 30.0 &&
                                                 cell_W.max.y() <= 10.0;
                          return is_inside ? 10.0 : 1.0;
                        },
                        1.0};
  const auto path = cells.path({2.0, 2.0, 0.0}, {38.0, 2.0, 0.0}, price);
  ASSERT_TRUE(path);
  const double around_m = 2.0 * std::hypot(8.0, 8.0) + 20.0;
  EXPECT_LE(path->cost, around_m);
  EXPECT_GE(path->cost, 0.9 * around_m);
}

}  // namespace
}  // namespace flyball
