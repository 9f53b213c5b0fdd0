// SPDX-License-Identifier: BSD-3-Clause
#include "maps/gap_finder.h"

#include "plan_scenes.h"
#include <cmath>

#include <gtest/gtest.h>

namespace {

using flyball::CellState;
using flyball::Gap;
using flyball::GapGroup;
using flyball::MotionChecker;
using flyball::Vec3;
using flyball::kit::GridMap;

std::vector<GapGroup> gaps_in(const GridMap& map) {
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  return flyball::find_gaps(checker, {{0, -6, 1.37}, {12, 6, 1.63}});
}

GridMap wall_with_gap(double from_y_m, double to_y_m) {
  GridMap map{{{0, -6, 0}, {12, 6, 3}}, 0.15};
  map.fill({{6, -6, 0}, {6.15, 6, 3}}, CellState::occupied);
  map.fill({{6, from_y_m, 0}, {6.15, to_y_m, 2.1}}, CellState::free);
  return map;
}

TEST(GapFinder, finds_the_middle_of_a_door) {
  const auto groups = gaps_in(wall_with_gap(0.6, 1.35));
  ASSERT_FALSE(groups.empty());
  bool exact = false;
  for (const auto& group : groups) {
    const Gap& gap = group.front();
    exact = exact || ((gap.centre_W - Vec3{6.075, 0.975, 1.5}).norm() < 1e-5 &&
                      std::abs(gap.width_m - 0.75) < 1e-5 &&
                      std::abs(std::abs(gap.across_W.y()) - 1.0) < 1e-9);
    EXPECT_LT((gap.centre_W - Vec3{6.075, 0.975, 1.5}).norm(), 0.6);
  }
  EXPECT_TRUE(exact);
}

TEST(GapFinder, ignores_gaps_that_are_too_narrow_too_wide_or_above) {
  EXPECT_TRUE(gaps_in(wall_with_gap(0.6, 1.2)).empty());
  EXPECT_TRUE(gaps_in(wall_with_gap(0.6, 2.7)).empty());
  GridMap window{{{0, -6, 0}, {12, 6, 3}}, 0.15};
  window.fill({{6, -6, 0}, {6.15, 6, 3}}, CellState::occupied);
  window.fill({{6, 0.6, 1.95}, {6.15, 1.35, 3}}, CellState::free);
  EXPECT_TRUE(gaps_in(window).empty());
  EXPECT_TRUE(gaps_in(GridMap{{{0, -6, 0}, {12, 6, 3}}, 0.15}).empty());
}

TEST(GapFinder, finds_doors_in_walls_that_stand_askew) {
  GridMap map{{{0, -6, 0}, {12, 6, 3}}, 0.05};
  const Vec3 along = Vec3{std::cos(0.5), std::sin(0.5), 0.0};
  const Vec3 middle{6, 0, 0};
  for (double s = -5.0; s <= 5.0; s += 0.01) {
    if (std::abs(s) > 0.5) {
      const Vec3 p = middle + s * along;
      map.fill({p - Vec3{0.05, 0.05, 0}, p + Vec3{0.05, 0.05, 3}}, CellState::occupied);
    }
  }
  const auto groups = gaps_in(map);
  double nearest = 1.0;
  for (const auto& group : groups) {
    nearest = std::min(nearest, (group.front().centre_W - Vec3{6, 0, 1.5}).norm());
  }
  EXPECT_LT(nearest, 0.1);
}

TEST(GapFinder, gives_up_on_regions_that_are_too_large) {
  const GridMap map = wall_with_gap(0.6, 1.35);
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_TRUE(flyball::find_gaps(checker, {{-1e5, -1e5, 1}, {1e5, 1e5, 2}}).empty());
  EXPECT_TRUE(flyball::find_gaps(checker, {{1, 1, 1}, {0, 0, 2}}).empty());
}

}  // namespace
