// SPDX-License-Identifier: BSD-3-Clause
#include "motion_checker.h"

#include "plan_scenes.h"

#include <gtest/gtest.h>

namespace {

using flyball::CellState;
using flyball::MotionChecker;
using flyball::kit::GridMap;

GridMap wall_at_5_m() {
  GridMap map{{{0, -3, 0}, {10, 3, 6}}, 0.15};
  map.fill({{4.95, -3, 0}, {5.1, 3, 3}}, CellState::occupied);
  return map;
}

TEST(MotionChecker, refuses_steep_pieces_unless_they_are_short) {
  const GridMap map = wall_at_5_m();
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_TRUE(checker.is_flyable({1, 0, 1}, {3, 0, 1.7}));   // 19 degrees
  EXPECT_FALSE(checker.is_flyable({1, 0, 1}, {3, 0, 1.8}));  // 22 degrees
  EXPECT_FALSE(checker.is_flyable({1, 0, 1.8}, {3, 0, 1.0}));
  EXPECT_FALSE(checker.is_flyable({1, 0, 1}, {1, 0, 1.31}));
  EXPECT_TRUE(checker.is_flyable({1, 0, 1}, {1, 0, 1.29}));
}

TEST(MotionChecker, crosses_unknown_but_not_occupied_space) {
  GridMap map = wall_at_5_m();
  map.fill({{6, -3, 0}, {10, 3, 6}}, CellState::unknown);
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_TRUE(checker.is_free({8, 0, 1}));
  EXPECT_TRUE(checker.is_flyable({6, 0, 1}, {9, 0, 1}));
  EXPECT_FALSE(checker.is_free({4.7, 0, 1}));
  EXPECT_FALSE(checker.is_flyable({4, 0, 1}, {6, 0, 1}));
  EXPECT_TRUE(checker.is_flyable({4, 0, 4}, {6, 0, 4}));
}

TEST(MotionChecker, counts_looks_at_cells_as_parts_of_a_body_query) {
  const GridMap map = wall_at_5_m();
  MotionChecker checker{map, flyball::kit::slow_body(), 0.35};
  EXPECT_EQ(checker.queries(), 0.0);
  (void)checker.is_free({1, 0, 1});
  (void)checker.is_flyable({1, 0, 1}, {2, 0, 1});
  EXPECT_NEAR(checker.clearance_m({1, 0, 1}, 10.0), 3.95, 1e-9);
  EXPECT_EQ(checker.queries(), 3.0);
  for (int i = 0; i < 16; ++i) {
    (void)checker.has_occupied({{0, 0, 0}, {1, 1, 1}});
  }
  EXPECT_EQ(checker.queries(), 4.0);
  EXPECT_FALSE(checker.is_flyable({1, 0, 1}, {1, 0, 2}));  // refused without a look at the map
  EXPECT_EQ(checker.queries(), 4.0);
}

}  // namespace
