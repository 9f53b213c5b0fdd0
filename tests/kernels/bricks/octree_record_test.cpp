// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "bricks/octree_record.h"

#include "bricks/brick_map.h"
#include "scans/ray_scan.h"
#include "world_scans.h"
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;

void clamp_as_mavbench(octomap::OcTree& tree) {
  tree.setClampingThresMin(0.12);
  tree.setClampingThresMax(0.97);
}

std::string bytes(const octomap::OcTree& tree) {
  std::stringstream stream;
  tree.write(stream);
  return stream.str();
}

struct Case {
  kit::Place place;
  double resolution_m;
};

class OctreeRecordInPlace : public testing::TestWithParam<Case> {};

TEST_P(OctreeRecordInPlace, is_the_tree_of_stock_insertion_byte_for_byte) {
  octomap::OcTree stock{GetParam().resolution_m};
  octomap::OcTree ours{GetParam().resolution_m};
  clamp_as_mavbench(stock);
  clamp_as_mavbench(ours);
  RayScan exact{GetParam().resolution_m, RayScan::Match::stock};
  OctreeRecord record;
  for (int frame = 0; frame < 10; ++frame) {
    const Scan scan = kit::world_scan(GetParam().place, frame, range_m);
    stock.insertPointCloud(kit::points_of(scan), scan.origin_W, range_m);
    record.write(exact.compute(scan).bricks, ours);
    ASSERT_TRUE(stock == ours) << "frame " << frame;
    ASSERT_EQ(bytes(stock), bytes(ours)) << "frame " << frame;
  }
  EXPECT_GT(ours.size(), 100U);
}

INSTANTIATE_TEST_SUITE_P(places,
                         OctreeRecordInPlace,
                         testing::Values(Case{kit::Place::indoor, 0.15},
                                         Case{kit::Place::indoor, 0.30},
                                         Case{kit::Place::indoor, 0.80},
                                         Case{kit::Place::outdoor, 0.15},
                                         Case{kit::Place::outdoor, 0.30},
                                         Case{kit::Place::outdoor, 0.80}),
                         [](const auto& param) {
                           const std::string place =
                               param.param.place == kit::Place::indoor ? "indoor" : "outdoor";
                           return place + "_" +
                                  std::to_string(std::lround(100 * param.param.resolution_m)) +
                                  "cm";
                         });

/// Every cell of the bricks around the middle: what a map says that was shown all changes, and what
/// the tree says.
void expect_shows(const BrickMap& shown, const octomap::OcTree& tree) {
  constexpr int edge = 160;
  const auto key = [](int i) { return Lattice::half_keys - edge / 2 + i; };
  for (int i = 0; i < edge * edge * edge; ++i) {
    const CellKey cell{key(i % edge), key(i / edge % edge), key(i / edge / edge)};
    const auto octomap_key = [](int k) { return static_cast<octomap::key_type>(k); };
    const auto* node = tree.search(
        octomap::OcTreeKey{octomap_key(cell.x), octomap_key(cell.y), octomap_key(cell.z)});
    const CellState expected = node == nullptr             ? CellState::unknown
                               : tree.isNodeOccupied(node) ? CellState::occupied
                                                           : CellState::free;
    ASSERT_EQ(shown.cells().state(cell, 0), expected) << cell.x << " " << cell.y << " " << cell.z;
  }
}

TEST(OctreeRecord, tells_all_bricks_whose_cells_have_new_states_and_few_others) {
  octomap::OcTree tree{0.15};
  clamp_as_mavbench(tree);
  RayScan exact{0.15, RayScan::Match::stock};
  OctreeRecord record;
  BrickMap shown = BrickMap::of_states(0.15);
  std::size_t told = 0;
  std::size_t written = 0;
  for (int frame = 0; frame < 10; ++frame) {
    const auto& bricks = exact.compute(kit::world_scan(kit::Place::indoor, frame, range_m)).bricks;
    const auto& changed = record.write(bricks, tree);
    shown.show(changed);
    written += frame > 0 ? bricks.size() : 0;
    told += frame > 0 ? changed.size() : 0;
  }
  expect_shows(shown, tree);
  EXPECT_GT(told, 0U);
  EXPECT_LT(2 * told, written);
}

/// Blocks of 1 to 16 cells, freed as a whole or hit in places.
std::vector<BrickMasks> random_blocks(std::mt19937_64& generator) {
  std::vector<BrickMasks> changes;
  const int edge = 1 << generator() % 3;
  const int first = (Lattice::half_keys >> 2) - 4 + static_cast<int>(generator() % 8);
  for (int brick = 0; brick < 512; ++brick) {
    const CellKey at{brick_offset(static_cast<std::size_t>(brick), 0),
                     brick_offset(static_cast<std::size_t>(brick), 1),
                     brick_offset(static_cast<std::size_t>(brick), 2)};
    if (std::max({at.x, at.y, at.z}) < edge) {
      changes.push_back(
          {{8 * (first >> 3) + at.x, 8 * (first >> 3) + at.y, at.z + 8184}, ~std::uint64_t{0}, 0});
    }
  }
  if (generator() % 2 == 0) {
    changes.back().hit = generator() & generator();
    changes.back().free &= ~changes.back().hit;
  }
  return changes;
}

TEST(OctreeRecord, frees_whole_blocks_as_stock_frees_their_cells_one_by_one) {
  octomap::OcTree stock{0.2};
  octomap::OcTree ours{0.2};
  OctreeRecord record;
  BrickMap shown = BrickMap::of_states(0.2);
  std::mt19937_64 generator{11};
  for (int round = 0; round < 60; ++round) {
    const auto changes = random_blocks(generator);
    for (const BrickMasks& change : changes) {
      for (int bit = 0; bit < 64; ++bit) {
        const auto key = [&](int brick, int offset) {
          return static_cast<octomap::key_type>(4 * brick + (offset & 3));
        };
        const octomap::OcTreeKey cell{key(change.brick.x, bit), key(change.brick.y, bit >> 2),
                                      key(change.brick.z, bit >> 4)};
        if (((change.free | change.hit) >> bit & 1U) != 0) {
          stock.updateNode(cell, (change.hit >> bit & 1U) != 0);
        }
      }
    }
    shown.show(record.write(changes, ours));
    ASSERT_EQ(bytes(stock), bytes(ours)) << "round " << round;
  }
  expect_shows(shown, ours);
  EXPECT_GT(ours.size(), 100U);
}

TEST(OctreeRecord, follows_rays_along_axes_through_corners_and_inside_one_cell_as_stock_does) {
  octomap::OcTree stock{0.15};
  octomap::OcTree ours{0.15};
  RayScan exact{0.15, RayScan::Match::stock};
  OctreeRecord record;
  Scan scan;
  scan.range_m = 3.0;
  for (const float x : {-4.0F, -1.2F, -0.3F, -0.01F, 0.0F, 0.01F, 0.3F, 1.2F, 4.0F}) {
    for (const float y : {-1.2F, 0.0F, 0.15F, 1.2F}) {
      for (const float z : {-1.2F, 0.0F, 1.2F, 0.6F}) {
        scan.hits_W.emplace_back(x, y, z);
      }
    }
  }
  for (const float start : {0.0F, 0.075F, 0.15F, 0.6F}) {
    scan.origin_W = {start, start, start};
    stock.insertPointCloud(kit::points_of(scan), scan.origin_W, scan.range_m);
    record.write(exact.compute(scan).bricks, ours);
    ASSERT_EQ(bytes(stock), bytes(ours)) << "from " << start;
  }
}

TEST(OctreeRecord, starts_a_tree_from_any_single_cell) {
  for (int bit = 0; bit < 64; ++bit) {
    octomap::OcTree stock{0.2};
    octomap::OcTree ours{0.2};
    OctreeRecord record;
    const auto& changed = record.write({{{8192, 8192, 8192}, 0, std::uint64_t{1} << bit}}, ours);
    ASSERT_EQ(changed.size(), 1U);
    EXPECT_EQ(changed.front().states.occupied, std::uint64_t{1} << bit);
    EXPECT_EQ(changed.front().states.unknown, ~(std::uint64_t{1} << bit));
    const auto key = [&](int offset) {
      return static_cast<octomap::key_type>(32768 + (offset & 3));
    };
    stock.updateNode(octomap::OcTreeKey{key(bit), key(bit >> 2), key(bit >> 4)}, true);
    ASSERT_EQ(bytes(stock), bytes(ours)) << "cell " << bit;
  }
}

TEST(OctreeRecord, leaves_the_tree_alone_without_changes) {
  octomap::OcTree tree{0.15};
  OctreeRecord{}.write({}, tree);
  EXPECT_EQ(tree.size(), 0U);
}

}  // namespace
}  // namespace flyball
