// SPDX-License-Identifier: BSD-3-Clause
#include "planning/state_grid.h"

#include "explore_scenes.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(StateGrid, says_what_the_map_says_and_unknown_outside) {
  const kit::GridMap map = kit::two_rooms();
  const StateGrid grid{map, {{0, 0, 0}, {12, 6, 3}}};
  ASSERT_EQ(grid.size(), 80U * 40U * 20U);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const GridCell cell = grid.cell_at(i);
    ASSERT_EQ(grid.index(cell), i);
    EXPECT_EQ(grid.at(cell), map.state(grid.centre(cell)));
  }
  EXPECT_EQ(grid.at({-1, 0, 0}), CellState::unknown);
}

TEST(StateGrid, sees_through_the_unknown_but_not_through_walls) {
  const kit::GridMap map = kit::two_rooms();
  const StateGrid grid{map, {{0, 0, 0}, {12, 6, 3}}};
  double crossed = 0.0;
  const Vec3 camera_W{3.0, 3.0, 1.2};
  EXPECT_TRUE(grid.sees(camera_W, grid.cell_of({9.0, 3.0, 1.2}), crossed));
  EXPECT_EQ(crossed, 41.0);
  EXPECT_FALSE(grid.sees(camera_W, grid.cell_of({9.0, 0.5, 1.2}), crossed));
  EXPECT_TRUE(grid.sees(camera_W, grid.cell_of({6.05, 0.5, 1.2}), crossed)) << "the wall itself";
}

TEST(StateGrid, is_the_same_when_several_threads_ask) {
  const kit::GridMap map = kit::two_rooms();
  const StateGrid alone{map, {{0, 0, 0}, {12, 6, 3}}};
  const StateGrid together{map, {{0, 0, 0}, {12, 6, 3}}, 4};
  ASSERT_EQ(together.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    ASSERT_EQ(together.at(together.cell_at(i)), alone.at(alone.cell_at(i))) << i;
  }
}

}  // namespace
}  // namespace flyball
