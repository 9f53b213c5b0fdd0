// SPDX-License-Identifier: BSD-3-Clause
#include "scans/clear_spaces.h"

#include "flyball/runtime/random.h"

#include "visual/overlap.h"
#include <algorithm>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double cell_m = 0.15;

/// A box's parts in cells of an edge.
std::vector<Aabb> cells_of(const Aabb& box, double edge_m) {
  std::vector<Aabb> cells;
  const auto first = [&](int axis) { return static_cast<int>(std::floor(box.min[axis] / edge_m)); };
  for (int x = first(0); x * edge_m < box.max.x(); ++x) {
    for (int y = first(1); y * edge_m < box.max.y(); ++y) {
      for (int z = first(2); z * edge_m < box.max.z(); ++z) {
        const Vec3 low = edge_m * Vec3{1.0 * x, 1.0 * y, 1.0 * z};
        cells.push_back(intersection({low, low + Vec3::Constant(edge_m)}, box));
      }
    }
  }
  return cells;
}

TEST(ClearSpaces, cover_a_box_exactly_when_they_cover_the_cells_that_a_map_cuts_it_into) {
  RandomStream random{3, "clear spaces"};
  int covered = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 p{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(0.5, 2.0)};
    const BodyShape body{p, {0.355, 0.185}};
    ClearSpaces spaces;
    for (int i = 0; i < 5; ++i) {
      const Vec3 beside{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2),
                        random.uniform(-0.1, 0.1)};
      spaces.declare(p + beside, {random.uniform(0.3, 0.5), random.uniform(0.1, 0.3)});
    }
    const bool whole = spaces.cover(body.bounds(), body);
    covered += whole ? 1 : 0;
    for (const double edge_m : {cell_m, 2.0 * cell_m, 4.0 * cell_m, 32.0 * cell_m}) {
      const auto cells = cells_of(body.bounds(), edge_m);
      ASSERT_EQ(whole, std::all_of(cells.begin(), cells.end(),
                                   [&](const Aabb& cell) { return spaces.cover(cell, body); }))
          << "trial " << trial << ", cells of " << edge_m << " m";
    }
  }
  EXPECT_GT(covered, 100);
  EXPECT_LT(covered, 2900);
}

TEST(ClearSpaces, cover_no_body_of_which_a_part_looks_out) {
  ClearSpaces spaces;
  const Vec3 p{0.3, -0.2, 1.0};
  spaces.declare(p, {0.4, 0.2});
  const auto is_covered = [&](const Vec3& beside) {
    const BodyShape body{p + beside, {0.35, 0.15}};
    return spaces.cover(body.bounds(), body);
  };
  EXPECT_TRUE(is_covered({0.0, 0.0, 0.0}));
  EXPECT_TRUE(is_covered({0.049, 0.0, 0.049}));
  EXPECT_FALSE(is_covered({0.0, 0.0, 0.051}));
  EXPECT_FALSE(is_covered({0.06, 0.0, 0.0}));
}

}  // namespace
}  // namespace flyball
