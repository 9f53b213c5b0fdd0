// SPDX-License-Identifier: BSD-3-Clause
#include "world/scan_file.h"

#include "flyball/runtime/random.h"

#include "scratch_folder.h"
#include <cstring>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <octomap/octomap.h>

namespace flyball {
namespace {

class ScanFile : public testing::Test {
 protected:
  void write(const std::string& bytes) const { std::ofstream{path, std::ios::binary} << bytes; }
  void compare(const octomap::OcTree& tree) const {
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
  const ScratchFolder scratch;
  const std::string path = scratch.path("scan.bt");
};

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
  tree.prune();
  ASSERT_TRUE(tree.write(path));  // Log-odds: both ways of writing, one answer.
  compare(tree);
  tree.toMaxLikelihood();
  tree.prune();
  ASSERT_TRUE(tree.writeBinary(path));
  compare(tree);
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
  EXPECT_NE(read_scan(path).error().message.find("no OcTree"), std::string::npos);
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

TEST_F(ScanFile, with_cells_of_no_size_that_a_map_has_is_refused) {
  octomap::OcTree tree{0.1};
  tree.updateNode(0.05, 0.05, 0.05, true);
  ASSERT_TRUE(tree.writeBinary(path));
  std::ifstream stream{path, std::ios::binary};
  const std::string bytes{std::istreambuf_iterator<char>{stream}, {}};
  const std::size_t at = bytes.find("res 0.1");
  for (const char* size : {"1e308", "-1", "0", "nan", "inf", "1e-300", "0.009", "10.1", "wide"}) {
    write(bytes.substr(0, at) + "res " + size + bytes.substr(at + 7));
    const auto grid = read_scan(path);
    ASSERT_FALSE(grid) << size;
    EXPECT_NE(grid.error().message.find("not between 0.01 and 10 m"), std::string::npos) << size;
  }
}

TEST_F(ScanFile, of_log_odds_that_is_cut_off_or_not_finite_is_refused) {
  octomap::OcTree tree{0.1};
  tree.updateNode(0.05, 0.05, 0.05, true);
  ASSERT_TRUE(tree.write(path));
  std::ifstream stream{path, std::ios::binary};
  const std::string bytes{std::istreambuf_iterator<char>{stream}, {}};
  const std::size_t tree_at = bytes.find("data\n") + 5;
  for (std::size_t end = tree_at; end < bytes.size(); end += 3) {
    write(bytes.substr(0, end));
    EXPECT_FALSE(read_scan(path)) << end;
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string changed = bytes;
  std::memcpy(&changed[tree_at], &nan, sizeof nan);
  write(changed);
  EXPECT_FALSE(read_scan(path));
  changed = bytes;
  changed.back() = '\x01';  // A child below the deepest leaf.
  write(changed + std::string(5, '\0'));
  EXPECT_FALSE(read_scan(path));
}

TEST_F(ScanFile, that_is_a_folder_is_not_found) {
  EXPECT_EQ(read_scan(scratch.path()).error().code, ErrorCode::not_found);
}

TEST_F(ScanFile, that_the_system_does_not_open_is_not_called_missing) {
  const std::string loop = scratch.path("loop.bt");
  std::filesystem::create_symlink("loop.bt", loop);  // Root, too, may not read it.
  EXPECT_EQ(read_scan(loop).error().message,
            "cannot read map file \"" + loop + "\": Too many levels of symbolic links");
}

}  // namespace
}  // namespace flyball
