// SPDX-License-Identifier: BSD-3-Clause
#include "maps/ray_walk.h"

#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

void expect_stock_walk(const octomap::OcTree& lattice,
                       const octomap::point3d& from,
                       const octomap::point3d& to) {
  octomap::KeyRay stock;
  ASSERT_TRUE(lattice.computeRayKeys(from, to, stock));
  std::size_t i = 0;
  const std::size_t visited = RayWalk{lattice, from, to}.visit_free([&](const RayWalk::Cell& cell) {
    ASSERT_LT(i, stock.size());
    const octomap::OcTreeKey& key = *(stock.begin() + static_cast<std::ptrdiff_t>(i++));
    ASSERT_TRUE(cell[0] == key[0] && cell[1] == key[1] && cell[2] == key[2])
        << "step " << i << " from " << from << " to " << to;
  });
  ASSERT_EQ(visited, stock.size()) << "from " << from << " to " << to;
}

TEST(RayWalk, visits_the_cells_of_stock_in_their_order) {
  std::mt19937 generator{1};
  std::uniform_real_distribution<float> coordinate{-20.0F, 20.0F};
  const auto point = [&] {
    const float x = coordinate(generator);
    const float y = coordinate(generator);
    return octomap::point3d{x, y, coordinate(generator)};
  };
  for (const double resolution_m : {0.1, 0.15, 0.3, 0.8}) {
    const octomap::OcTree lattice{resolution_m};
    for (int i = 0; i < 500; ++i) {
      const octomap::point3d from = point();
      expect_stock_walk(lattice, from, point());
    }
  }
}

TEST(RayWalk, breaks_ties_at_corners_as_stock_does) {
  const octomap::OcTree lattice{0.25};
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    const auto at = [](int step) { return 0.5F * static_cast<float>(step % 9 - 4); };
    const octomap::point3d to{at(i), at(i / 9), at(i / 81)};
    expect_stock_walk(lattice, {0.0F, 0.0F, 0.0F}, to);
    expect_stock_walk(lattice, {0.125F, 0.125F, 0.125F}, to);
  }
}

TEST(RayWalk, is_empty_where_floats_lose_its_length) {
  const octomap::OcTree lattice{0.15};
  const octomap::point3d from{0.0F, 0.0F, 0.0F};
  const octomap::point3d to{-1e-25F, -1e-25F, 1e-25F};  // Other cells, and no way to them.
  EXPECT_EQ((RayWalk{lattice, from, to}.visit_free([](const RayWalk::Cell&) {})), 0U);
}

}  // namespace
}  // namespace flyball
