// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "scans/ray_scan.h"

#include "mask_cells.h"
#include "world_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;

using kit::Cells;
using kit::cells_of;

struct StockUpdate {
  Cells cells;
  std::size_t traversals{};
};

StockUpdate stock_update(const Scan& scan, double resolution_m) {
  octomap::OcTree tree{resolution_m};
  const octomap::Pointcloud points = kit::points_of(scan);
  octomap::KeySet free;
  octomap::KeySet hit;
  tree.computeUpdate(points, scan.origin_W, free, hit, scan.range_m);
  StockUpdate update;
  for (const auto& key : free) {
    update.cells[{key[0], key[1], key[2]}] = false;
  }
  for (const auto& key : hit) {
    update.cells[{key[0], key[1], key[2]}] = true;
  }
  octomap::KeyRay walk;
  for (const auto& p_W : points) {
    const octomap::point3d ray = p_W - scan.origin_W;
    const bool is_cut = ray.norm() > scan.range_m;
    const auto end =
        is_cut ? scan.origin_W + ray.normalized() * static_cast<float>(scan.range_m) : p_W;
    EXPECT_TRUE(tree.computeRayKeys(scan.origin_W, end, walk));
    update.traversals += walk.size();
  }
  return update;
}

void expect_same(const ScanMasks& masks, const StockUpdate& stock) {
  EXPECT_TRUE(cells_of(masks) == stock.cells);
  EXPECT_EQ(masks.updates, stock.cells.size());
  EXPECT_EQ(masks.traversals, stock.traversals);
}

TEST(RayScan, marks_and_counts_what_stock_does_with_all_vector_instructions) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    for (const double resolution_m : {0.15, 0.3, 0.98}) {
      for (const Simd simd : supported_simd()) {
        RayScan exact{resolution_m, RayScan::Match::stock, simd};
        for (int frame = 0; frame < 3; ++frame) {
          const Scan scan = kit::world_scan(place, frame, range_m);
          const ScanMasks& masks = exact.compute(scan);
          EXPECT_EQ(masks.rays, 64 * 36);
          expect_same(masks, stock_update(scan, resolution_m));
        }
      }
    }
  }
}

// Ends on borders and rays through corners: every order of crossings is in doubt.
TEST(RayScan, walks_ambiguous_rays_as_stock_does) {
  RayScan exact{0.15, RayScan::Match::stock};
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
    expect_same(exact.compute(scan), stock_update(scan, 0.15));
    EXPECT_GT(exact.ambiguous_rays(), 10U);
  }
}

TEST(RayScan, gives_the_same_close_match_with_all_vector_instructions) {
  RayScan portable{0.15, RayScan::Match::close, Simd::portable};
  for (const Simd simd : supported_simd()) {
    RayScan wide{0.15, RayScan::Match::close, simd};
    for (int frame = 0; frame < 3; ++frame) {
      const Scan scan = kit::world_scan(kit::Place::outdoor, frame, range_m);
      EXPECT_TRUE(cells_of(wide.compute(scan)) == cells_of(portable.compute(scan)));
    }
  }
}

TEST(RayScan, differs_from_stock_in_few_cells_where_it_may) {
  RayScan close{0.15, RayScan::Match::close};
  const Scan scan = kit::world_scan(kit::Place::indoor, 3, range_m);
  const Cells ours = cells_of(close.compute(scan));
  const Cells stock = stock_update(scan, 0.15).cells;
  std::size_t wrong = 0;
  for (const auto& [cell, is_hit] : stock) {
    const auto found = ours.find(cell);
    wrong += found == ours.end() || found->second != is_hit ? 1 : 0;
  }
  EXPECT_LT(wrong, stock.size() / 1000);
  EXPECT_LT(ours.size(), stock.size() + stock.size() / 1000);
}

TEST(RayScan, frees_a_short_clear_ray_to_its_end_and_marks_nothing) {
  RayScan exact{0.1, RayScan::Match::stock};
  Scan scan;
  scan.range_m = 5.0;
  scan.origin_W = {0.05F, 0.05F, 0.05F};
  scan.clear_W = {{1.05F, 0.05F, 0.05F}};
  const ScanMasks& masks = exact.compute(scan);
  EXPECT_EQ(masks.updates, 10);
  for (const BrickMasks& brick : masks.bricks) {
    EXPECT_EQ(brick.hit, 0U);
  }
}

TEST(RayScan, takes_points_to_the_world_as_the_pose_does_one_by_one) {
  for (const int width_px : {64, 37}) {
    for (int frame = 0; frame < 4; ++frame) {
      const auto from = kit::synthetic_scan(kit::Place::outdoor, frame, range_m, width_px);
      const Scan expected = kit::world_scan(kit::Place::outdoor, frame, range_m, width_px);
      Scan scan;
      to_world(from.cloud_C, from.X_WC, scan);
      EXPECT_TRUE(scan.hits_W == expected.hits_W);
      EXPECT_TRUE(scan.clear_W == expected.clear_W);
      EXPECT_TRUE(scan.origin_W == expected.origin_W);
    }
  }
}

TEST(RayScan, has_nothing_to_say_without_rays) {
  RayScan exact{0.15, RayScan::Match::stock};
  Scan scan;
  scan.range_m = 7.0;
  EXPECT_TRUE(exact.compute(scan).bricks.empty());
}

}  // namespace
}  // namespace flyball
