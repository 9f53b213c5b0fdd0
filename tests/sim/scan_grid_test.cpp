// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/scan_grid.h"

#include "flyball/runtime/random.h"

#include "scratch_folder.h"
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace flyball {
namespace {

using Index = ScanGrid::Index;

class ScanFile : public testing::Test {
 protected:
  void write(const std::string& bytes) const { std::ofstream{path, std::ios::binary} << bytes; }
  const ScratchFolder scratch;
  const std::string path = scratch.path("scan.bt");
};

double volume(const std::vector<Aabb>& boxes) {
  double sum = 0.0;
  for (const Aabb& box : boxes) {
    sum += (box.max - box.min).prod();
  }
  return sum;
}

TEST_F(ScanFile, says_the_same_of_each_cell_as_octomap_does) {
  octomap::OcTree tree{0.1};
  RandomStream random{11, "scan_grid_test"};
  for (int i = 0; i < 400; ++i) {
    const auto x = random.uniform(-1.5, 1.5);
    const auto y = random.uniform(-1.5, 1.5);
    const auto z = random.uniform(-1.0, 1.0);
    tree.updateNode(
        octomap::point3d(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)),
        i % 3 == 0);
  }
  for (int cell = 0; cell < 8; ++cell) {  // Eight equal neighbours: they become one larger leaf.
    tree.updateNode(0.05 + 0.1 * (cell & 1), 0.05 + 0.1 * ((cell >> 1) & 1),
                    1.65 + 0.1 * ((cell >> 2) & 1), true);
  }
  tree.toMaxLikelihood();
  tree.prune();
  ASSERT_TRUE(tree.writeBinary(path));
  const auto grid = read_scan(path);
  ASSERT_TRUE(grid) << grid.error().message;
  EXPECT_EQ(grid->resolution_m(), 0.1);
  int occupied = 0;
  for (int z = -20; z < 20; ++z) {
    for (int y = -20; y < 20; ++y) {
      for (int x = -20; x < 20; ++x) {
        const auto* node = tree.search((x + 0.5) * 0.1, (y + 0.5) * 0.1, (z + 0.5) * 0.1);
        const CellState expected = node == nullptr             ? CellState::unknown
                                   : tree.isNodeOccupied(node) ? CellState::occupied
                                                               : CellState::free;
        ASSERT_EQ(grid->state({x, y, z}), expected) << x << " " << y << " " << z;
        occupied += expected == CellState::occupied ? 1 : 0;
      }
    }
  }
  EXPECT_GT(occupied, 100);
}

TEST_F(ScanFile, that_is_cut_off_or_foreign_or_empty_is_refused) {
  octomap::OcTree tree{0.1};
  tree.updateNode(0.05, 0.05, 0.05, true);
  ASSERT_TRUE(tree.writeBinary(path));
  std::ifstream stream{path, std::ios::binary};
  const std::string bytes{std::istreambuf_iterator<char>{stream}, {}};
  write(bytes.substr(0, bytes.size() - 5));
  EXPECT_NE(read_scan(path).error().message.find("ends early"), std::string::npos);
  write("ply\n" + bytes);
  EXPECT_NE(read_scan(path).error().message.find("no binary OcTree"), std::string::npos);
  write(bytes.substr(0, bytes.find("data\n") + 5) + std::string(2, '\0'));
  EXPECT_NE(read_scan(path).error().message.find("empty"), std::string::npos);
}

TEST_F(ScanFile, with_cells_too_far_apart_is_refused) {
  octomap::OcTree tree{0.1};
  tree.updateNode(-1000.0, -1000.0, 0.0, true);
  tree.updateNode(1000.0, 1000.0, 0.0, true);
  ASSERT_TRUE(tree.writeBinary(path));
  EXPECT_NE(read_scan(path).error().message.find("2e8"), std::string::npos);
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

}  // namespace
}  // namespace flyball
