// SPDX-License-Identifier: BSD-3-Clause
#include "../../kernels/src/scan_update.h"

#include "synthetic_scans.h"
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

Scan in_world(const kit::SyntheticScan& from) {
  Scan scan;
  const auto to_W = [](const Vec3& p) {
    return octomap::point3d{static_cast<float>(p.x()), static_cast<float>(p.y()),
                            static_cast<float>(p.z())};
  };
  for (const auto& p_C : from.cloud_C.hits_C) {
    scan.hits_W.push_back(to_W(from.X_WC * p_C.cast<double>()));
  }
  for (const auto& p_C : from.cloud_C.clear_C) {
    scan.clear_W.push_back(to_W(from.X_WC * p_C.cast<double>()));
  }
  scan.origin_W = to_W(from.X_WC.translation());
  scan.range_m = range_m;
  return scan;
}

octomap::Pointcloud points_of(const Scan& scan) {
  octomap::Pointcloud points;
  for (const auto* ends : {&scan.hits_W, &scan.clear_W}) {
    for (const auto& p : *ends) {
      points.push_back(p);
    }
  }
  return points;
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

class ScanUpdateInPlace : public testing::TestWithParam<Case> {};

TEST_P(ScanUpdateInPlace, makes_the_tree_of_stock_insertion_byte_for_byte) {
  octomap::OcTree stock{GetParam().resolution_m};
  octomap::OcTree ours{GetParam().resolution_m};
  clamp_as_mavbench(stock);
  clamp_as_mavbench(ours);
  ScanUpdate update;
  for (int frame = 0; frame < 10; ++frame) {
    const Scan scan = in_world(kit::synthetic_scan(GetParam().place, frame, range_m));
    stock.insertPointCloud(points_of(scan), scan.origin_W, range_m);
    update.compute(ours, scan);
    update.apply(ours);
    ASSERT_TRUE(stock == ours) << "frame " << frame;
    ASSERT_EQ(bytes(stock), bytes(ours)) << "frame " << frame;
  }
  EXPECT_GT(ours.size(), 100U);
}

TEST_P(ScanUpdateInPlace, counts_the_cells_that_stock_walks_and_updates) {
  const octomap::OcTree lattice{GetParam().resolution_m};
  octomap::OcTree stock{GetParam().resolution_m};
  const Scan scan = in_world(kit::synthetic_scan(GetParam().place, 3, range_m));
  octomap::KeySet free_cells;
  octomap::KeySet occupied_cells;
  stock.computeUpdate(points_of(scan), scan.origin_W, free_cells, occupied_cells, range_m);
  octomap::KeyRay walk;
  std::size_t traversals = 0;
  for (const auto& p_W : points_of(scan)) {
    const octomap::point3d ray = p_W - scan.origin_W;
    const bool is_cut = ray.norm() > range_m;
    const auto end = is_cut ? scan.origin_W + ray.normalized() * static_cast<float>(range_m) : p_W;
    ASSERT_TRUE(lattice.computeRayKeys(scan.origin_W, end, walk));
    traversals += walk.size();
  }
  const auto counts = ScanUpdate{}.compute(lattice, scan);
  EXPECT_EQ(counts.rays, 64 * 36);
  EXPECT_EQ(counts.traversals, traversals);
  EXPECT_EQ(counts.updates, free_cells.size() + occupied_cells.size());
}

INSTANTIATE_TEST_SUITE_P(places,
                         ScanUpdateInPlace,
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

TEST(ScanUpdate, walks_along_axes_through_corners_and_inside_one_cell_as_stock_does) {
  octomap::OcTree stock{0.15};
  octomap::OcTree ours{0.15};
  ScanUpdate update;
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
    stock.insertPointCloud(points_of(scan), scan.origin_W, scan.range_m);
    update.compute(ours, scan);
    update.apply(ours);
    ASSERT_EQ(bytes(stock), bytes(ours)) << "from " << start;
  }
}

TEST(ScanUpdate, starts_a_tree_from_any_single_cell) {
  for (int cell = 0; cell < 64; ++cell) {
    const auto at = [&](int i) { return 0.2F * (static_cast<float>(i % 4) + 0.5F); };
    Scan scan;
    scan.range_m = 5.0;
    scan.origin_W = {at(cell), at(cell / 4), at(cell / 16)};
    scan.hits_W = {scan.origin_W};
    octomap::OcTree ours{0.2};
    ScanUpdate update;
    update.compute(ours, scan);
    update.apply(ours);
    octomap::OcTree stock{0.2};
    stock.updateNode(scan.origin_W, true);
    ASSERT_EQ(bytes(stock), bytes(ours)) << "cell " << cell;
  }
}

TEST(ScanUpdate, frees_a_short_clear_ray_to_its_end_and_marks_nothing) {
  octomap::OcTree tree{0.1};
  ScanUpdate update;
  Scan scan;
  scan.range_m = 5.0;
  scan.origin_W = {0.05F, 0.05F, 0.05F};
  scan.clear_W = {{1.05F, 0.05F, 0.05F}};
  const auto counts = update.compute(tree, scan);
  update.apply(tree);
  EXPECT_EQ(counts.updates, 10);
  EXPECT_FALSE(tree.isNodeOccupied(tree.search(0.95, 0.05, 0.05)));
  EXPECT_EQ(tree.search(1.05, 0.05, 0.05), nullptr);
}

TEST(ScanUpdate, applies_a_change_only_once) {
  octomap::OcTree tree{0.15};
  ScanUpdate update;
  update.compute(tree, in_world(kit::synthetic_scan(kit::Place::indoor, 0, range_m)));
  update.apply(tree);
  const std::string once = bytes(tree);
  update.apply(tree);
  EXPECT_EQ(bytes(tree), once);
}

TEST(ScanUpdate, leaves_the_tree_alone_without_rays) {
  octomap::OcTree tree{0.15};
  ScanUpdate update;
  Scan scan;
  scan.range_m = 7.0;
  const auto counts = update.compute(tree, scan);
  update.apply(tree);
  EXPECT_EQ(counts.updates, 0);
  EXPECT_EQ(tree.size(), 0U);
}

}  // namespace
}  // namespace flyball
