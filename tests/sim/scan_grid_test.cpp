// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/scan_grid.h"

#include "flyball/runtime/random.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace flyball {
namespace {

using Index = ScanGrid::Index;

double volume(const std::vector<Aabb>& boxes) {
  double sum = 0.0;
  for (const Aabb& box : boxes) {
    sum += (box.max - box.min).prod();
  }
  return sum;
}

TEST(MergedBoxes, cover_the_same_cells_with_fewer_boxes) {
  ScanGrid grid{0.5, {-4, -3, -2}, {5, 6, 7}};
  RandomStream random{3, "merged_boxes"};
  const auto is_occupied = [&](const Index& cell) {
    return grid.state(cell) == CellState::occupied;
  };
  int cells = 0;
  for (int z = -2; z <= 7; ++z) {
    for (int y = -3; y <= 6; ++y) {
      for (int x = -4; x <= 5; ++x) {
        const bool solid = random.uniform() < 0.4;
        grid.set({x, y, z}, solid ? CellState::occupied : CellState::free);
        cells += solid ? 1 : 0;
      }
    }
  }
  const std::vector<Aabb> boxes = merged_boxes(grid, is_occupied);
  EXPECT_LT(boxes.size(), static_cast<std::size_t>(cells));
  EXPECT_NEAR(volume(boxes), cells * 0.125, 1e-9);  // No overlap, if each cell is covered.
  for (int z = -2; z <= 7; ++z) {
    for (int y = -3; y <= 6; ++y) {
      for (int x = -4; x <= 5; ++x) {
        const Vec3 centre = (Index{x, y, z}.cast<double>() + Vec3::Constant(0.5)) * 0.5;
        const bool covered = std::any_of(boxes.begin(), boxes.end(),
                                         [&](const Aabb& box) { return box.contains(centre); });
        ASSERT_EQ(covered, is_occupied({x, y, z}));
      }
    }
  }
}

TEST(MergedBoxes, make_one_box_of_a_solid_block) {
  ScanGrid grid{0.1, {0, 0, 0}, {9, 4, 6}};
  const auto boxes =
      merged_boxes(grid, [](const Index& cell) { return cell.x() > 1 && cell.z() < 5; });
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_TRUE(boxes[0].min.isApprox(Vec3{0.2, 0.0, 0.0}));
  EXPECT_TRUE(boxes[0].max.isApprox(Vec3{1.0, 0.5, 0.5}));
}

TEST(MergedBoxes, make_one_box_of_more_cells_than_a_list_could_hold) {
  const ScanGrid grid{0.1, {0, 0, 0}, {399, 399, 399}};  // 64 million cells, a list of 1.5 GB.
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_EQ(merged_boxes(grid, [](const Index&) { return true; }).size(), 1U);
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000);  // kB
}

}  // namespace
}  // namespace flyball
