// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/path_break.h"

#include "grid_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Cylinder body{0.3, 0.2};
const std::vector<Vec3> path_W{{0, 0, 1}, {10, 0, 1}, {30, 0, 1}, {30, 10, 1}};

struct Land {
  std::optional<PathBreak> look() { return break_of(path_W, map, body, queries); }
  void block(const Aabb& box) { map.fill(box, CellState::occupied); }

  kit::GridMap map{{Vec3{-2, -8, 0}, Vec3{34, 12, 2}}, 0.15, CellState::free};
  double queries{};
};

TEST(PathBreak, is_none_in_a_path_that_is_free) {
  Land land;
  const auto found = land.look();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->before_W, path_W);
  EXPECT_TRUE(found->behind_W.empty());
  EXPECT_EQ(land.queries, 3.0);
}

TEST(PathBreak, lies_between_the_corner_before_it_and_a_place_right_behind_it) {
  Land land;
  land.block({{14, -2, 0}, {15, 2, 2}});
  const auto found = land.look();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->before_W, (std::vector<Vec3>{{0, 0, 1}, {10, 0, 1}}));
  ASSERT_EQ(found->behind_W.size(), 3U);
  EXPECT_GT(found->behind_W[0].x(), 15.3);
  EXPECT_LT(found->behind_W[0].x(), 16.4);
  EXPECT_FALSE(land.map.segment_hits(found->behind_W[0], found->behind_W[1], body));
  EXPECT_EQ(found->behind_W[2], path_W[3]);
}

TEST(PathBreak, goes_from_the_first_obstacle_to_the_last) {
  Land land;
  land.block({{5, -2, 0}, {6, 2, 2}});
  land.block({{29, 4, 0}, {31, 5, 2}});
  const auto found = land.look();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->before_W, (std::vector<Vec3>{{0, 0, 1}}));
  ASSERT_EQ(found->behind_W.size(), 2U);
  EXPECT_GT(found->behind_W[0].y(), 5.3);
}

TEST(PathBreak, at_the_end_cannot_be_mended) {
  Land land;
  land.block({{29, 9, 0}, {31, 11, 2}});
  EXPECT_FALSE(land.look().has_value());
}

}  // namespace
}  // namespace flyball
