// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/grid_walk.h"

#include "flyball/runtime/random.h"

#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::vector<GridCell> walked(const Vec3& from, const Vec3& to, double cell_m) {
  std::vector<GridCell> cells;
  walk_cells(from, to, cell_m, [&](const GridCell& cell) {
    cells.push_back(cell);
    return true;
  });
  return cells;
}

TEST(WalkCells, goes_from_the_first_cell_to_the_last_over_faces_only) {
  RandomStream random{7, "walk"};
  const auto point = [&] {
    const double x = random.uniform(-5.0, 5.0);
    const double y = random.uniform(-5.0, 5.0);
    return Vec3{x, y, random.uniform(-2.0, 2.0)};
  };
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = point();
    const Vec3 to = point();
    const auto cells = walked(from, to, 0.15);
    EXPECT_EQ(cells.front(), grid_cell_of(from, 0.15));
    EXPECT_EQ(cells.back(), grid_cell_of(to, 0.15));
    for (std::size_t k = 1; k < cells.size(); ++k) {
      int steps = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        steps += std::abs(cells[k][axis] - cells[k - 1][axis]);
      }
      EXPECT_EQ(steps, 1);
      // Each lies on the line: no farther from it than half its diagonal.
      const Vec3 along = (to - from).normalized();
      const Vec3 off = centre_of(cells[k], 0.15) - from;
      EXPECT_LT((off - off.dot(along) * along).norm(), 0.15 * 0.8661);
    }
  }
}

TEST(WalkCells, ends_where_it_is_told_to) {
  int visits = 0;
  EXPECT_FALSE(walk_cells({0.5, 0.5, 0.5}, {9.5, 0.5, 0.5}, 1.0,
                          [&](const GridCell&) { return ++visits < 4; }));
  EXPECT_EQ(visits, 4);
}

TEST(WalkCells, stays_in_the_one_cell_of_two_equal_points) {
  EXPECT_EQ(walked({0.2, 0.3, -0.1}, {0.2, 0.3, -0.1}, 1.0), (std::vector<GridCell>{{0, 0, -1}}));
}

}  // namespace
}  // namespace flyball
