// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "bricks/octree_copy.h"

#include "bricks/octree_record.h"
#include "scans/ray_scan.h"
#include "world_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double finest_m = 0.15;
constexpr double range_m = 7.0;

struct Pair {
  BrickMap bricks{finest_m};
  octomap::OcTree tree{finest_m};
};

/// The same frames in both.
void fly_through(kit::Place place, int frames, Pair& maps) {
  maps.tree.setClampingThresMin(0.12);
  maps.tree.setClampingThresMax(0.97);
  RayScan scan{finest_m, RayScan::Match::stock};
  OctreeRecord record;
  for (int frame = 0; frame < frames; ++frame) {
    const ScanMasks& masks = scan.compute(kit::world_scan(place, frame, range_m, 96));
    maps.bricks.apply(masks.bricks);
    record.write(masks.bricks, maps.tree);
  }
}

std::string stream_of(octomap::OcTree& tree) {
  std::ostringstream stream;
  EXPECT_TRUE(tree.writeBinary(stream));
  return stream.str();
}

TEST(OctreeCopy, the_file_is_byte_for_byte_that_of_the_stock_tree) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    Pair maps;
    fly_through(place, 5, maps);
    const auto copy = to_octree(maps.bricks, 0);
    EXPECT_EQ(stream_of(*copy), stream_of(maps.tree));
    EXPECT_GT(maps.tree.size(), 1000U);
  }
}

TEST(OctreeCopy, there_and_back_changes_no_cell) {
  Pair maps;
  fly_through(kit::Place::indoor, 5, maps);
  const auto again = to_bricks(*to_octree(maps.bricks, 0));
  ASSERT_TRUE(again.ok()) << again.error().message;
  ASSERT_EQ(again->cells().chunks().size(), maps.bricks.cells().chunks().size());
  std::size_t known = 0;
  for (const Chunk* chunk : maps.bricks.cells().chunks()) {
    const Chunk* twin = again->cells().find(chunk->key);
    ASSERT_NE(twin, nullptr);
    for (std::size_t brick = 0; brick < Chunk::brick_count; ++brick) {
      ASSERT_EQ(twin->masks[brick].occupied, chunk->masks[brick].occupied);
      ASSERT_EQ(twin->masks[brick].unknown, chunk->masks[brick].unknown);
      for (std::size_t cell = 0; cell < 64; ++cell) {
        // A step down: OctoMap's clamps lie within half a step of a brick's.
        ASSERT_NEAR(twin->bricks[brick].cells[cell], chunk->bricks[brick].cells[cell], 1.0);
        known += chunk->bricks[brick].cells[cell] != log_odds::unknown ? 1 : 0;
      }
      ASSERT_EQ(twin->block(chunk_level, brick).has_unknown,
                chunk->block(chunk_level, brick).has_unknown);
    }
  }
  EXPECT_GT(known, 10000U);
}

TEST(OctreeCopy, a_coarser_one_has_the_cells_of_that_level) {
  Pair maps;
  fly_through(kit::Place::indoor, 3, maps);
  for (const int level : {1, 2, 3}) {
    const auto coarse = to_octree(maps.bricks, level);
    EXPECT_DOUBLE_EQ(coarse->getResolution(), maps.bricks.lattice().cell_m(level));
    for (double x_m = -3.0; x_m < 9.0; x_m += 0.31) {
      const Vec3 p_W{x_m, 0.7, 1.1};
      const CellState state =
          maps.bricks.cells().state(maps.bricks.lattice().cell(p_W).above(level), level);
      const auto* node = coarse->search(p_W.x(), p_W.y(), p_W.z());
      EXPECT_EQ(node == nullptr, state == CellState::unknown) << p_W.transpose();
      if (node != nullptr) {
        EXPECT_EQ(coarse->isNodeOccupied(node), state == CellState::occupied) << p_W.transpose();
      }
    }
  }
}

TEST(OctreeCopy, a_continent_in_a_few_bytes_is_refused) {
  octomap::OcTree tree{finest_m};
  octomap::OcTreeNode* root = tree.updateNode(octomap::OcTreeKey{0, 0, 0}, false);
  ASSERT_NE(root, nullptr);
  tree.createNodeChild(tree.getRoot(), 7)->setLogOdds(-1.0F);
  const auto bricks = to_bricks(tree);
  ASSERT_FALSE(bricks.ok());
  EXPECT_NE(bricks.error().message.find("32 x 32 x 32"), std::string::npos);
}

TEST(OctreeCopy, a_wide_leaf_becomes_all_of_its_cells) {
  octomap::OcTree tree{finest_m};
  for (unsigned short z = 0; z < 16; ++z) {
    for (unsigned short y = 0; y < 16; ++y) {
      for (unsigned short x = 0; x < 16; ++x) {
        tree.setNodeValue(octomap::OcTreeKey(32768 + x, 32768 + y, 32768 + z), -1.0F);
      }
    }
  }
  tree.prune();
  const auto bricks = to_bricks(tree);
  ASSERT_TRUE(bricks.ok());
  EXPECT_EQ(bricks->cells().state(bricks->lattice().cell({0.0, 0.0, 0.0}).above(4), 4),
            CellState::free);
  EXPECT_EQ(bricks->cells().state(bricks->lattice().cell({0.0, 0.0, 0.0}).above(5), 5),
            CellState::unknown);
}

}  // namespace
}  // namespace flyball
