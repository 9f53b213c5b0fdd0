// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "scans/pyramid_scan.h"

#include "mask_cells.h"
#include "scans/ray_scan.h"
#include "wall_scan.h"
#include "world_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::Cells;
using kit::cells_of;

constexpr double range_m = 7.0;
constexpr double finest_m = 0.15;
constexpr int width_px = 160;

kit::SyntheticScan scan_of(kit::Place place, int frame) {
  return kit::synthetic_scan(place, frame, range_m, width_px);
}

Cells walked(kit::Place place, int frame) {
  RayScan exact{finest_m, RayScan::Match::stock};
  return cells_of(exact.compute(kit::world_scan(place, frame, range_m, width_px)));
}

struct Agreement {
  std::size_t hits{};  ///< Of the rays.
  std::size_t same_hits{};
  std::size_t free{};  ///< Of the rays.
  std::size_t same_free{};
  std::size_t more_free{};  ///< That no ray crosses.
  std::size_t freed_hits{};
};

Agreement compare(const Cells& rays, const Cells& pyramid) {
  Agreement agreement;
  for (const auto& [cell, is_hit] : rays) {
    const auto found = pyramid.find(cell);
    const bool is_known = found != pyramid.end();
    (is_hit ? agreement.hits : agreement.free) += 1;
    if (is_known) {
      agreement.same_hits += is_hit && found->second ? 1 : 0;
      agreement.same_free += !is_hit && !found->second ? 1 : 0;
      agreement.freed_hits += is_hit && !found->second ? 1 : 0;
    }
  }
  for (const auto& [cell, is_hit] : pyramid) {
    agreement.more_free += !is_hit && rays.find(cell) == rays.end() ? 1 : 0;
  }
  return agreement;
}

TEST(PyramidScan, finds_at_the_finest_level_nearly_what_the_rays_find) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    PyramidScan pyramid{finest_m};
    for (const int frame : {0, 4}) {
      const auto scan = scan_of(place, frame);
      const auto agreement = compare(
          walked(place, frame), cells_of(pyramid.compute(scan.cloud_C, scan.X_WC, range_m, 0)));
      EXPECT_EQ(agreement.same_hits, agreement.hits);
      EXPECT_EQ(agreement.freed_hits, 0U);
      // A ray may touch a cell whose centre it does not see.
      EXPECT_GT(agreement.same_free, agreement.free * 9 / 10);
      EXPECT_LT(agreement.more_free, agreement.free / 50);
    }
  }
}

TEST(PyramidScan, frees_above_the_finest_level_only_what_rays_cross) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    PyramidScan pyramid{finest_m};
    const auto scan = scan_of(place, 2);
    const Cells rays = walked(place, 2);
    std::size_t freed = rays.size();
    for (int level = 1; level <= 3; ++level) {
      const auto agreement =
          compare(rays, cells_of(pyramid.compute(scan.cloud_C, scan.X_WC, range_m, level)));
      EXPECT_EQ(agreement.same_hits, agreement.hits);
      EXPECT_EQ(agreement.freed_hits, 0U);
      EXPECT_LT(agreement.more_free, agreement.free / 1000);  // between the pixels of far cells
      // In the room no block of 1.2 m is seen as a whole.
      EXPECT_TRUE(level == 3 || agreement.same_free > agreement.free / 10);
      EXPECT_LT(agreement.same_free, freed);
      freed = agreement.same_free;
    }
  }
}

TEST(PyramidScan, frees_whole_blocks_of_its_floor) {
  PyramidScan pyramid{finest_m};
  const auto scan = scan_of(kit::Place::indoor, 1);
  const CellKey own = Lattice{finest_m}.cell(scan.X_WC.translation());
  for (const BrickMasks& brick : pyramid.compute(scan.cloud_C, scan.X_WC, range_m, 2).bricks) {
    const bool has_camera = brick.brick == own.above(brick_level);
    EXPECT_TRUE(has_camera || brick.free == 0 || (brick.free | brick.hit) == ~std::uint64_t{0});
  }
}

TEST(PyramidScan, gives_the_same_masks_with_all_vector_instructions) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    PyramidScan portable{finest_m, Simd::portable};
    for (const Simd simd : supported_simd()) {
      PyramidScan wide{finest_m, simd};
      for (int level = 0; level <= 3; ++level) {
        const auto scan = scan_of(place, level);
        EXPECT_TRUE(cells_of(wide.compute(scan.cloud_C, scan.X_WC, range_m, level)) ==
                    cells_of(portable.compute(scan.cloud_C, scan.X_WC, range_m, level)));
      }
    }
  }
}

TEST(PyramidScan, neither_frees_nor_marks_behind_a_pixel_without_a_measurement) {
  PyramidScan pyramid{finest_m};
  auto scan = scan_of(kit::Place::indoor, 0);
  scan.cloud_C.hits_C.clear();
  scan.cloud_C.clear_C.clear();
  const ScanMasks& masks = pyramid.compute(scan.cloud_C, scan.X_WC, range_m, 0);
  ASSERT_EQ(masks.bricks.size(), 1U);  // where the camera is
  EXPECT_EQ(masks.updates, 1.0);
}

TEST(PyramidScan, counts_the_blocks_that_it_looked_at) {
  PyramidScan pyramid{finest_m};
  const auto scan = scan_of(kit::Place::indoor, 0);
  const double fine = pyramid.compute(scan.cloud_C, scan.X_WC, range_m, 0).blocks;
  const double coarse = pyramid.compute(scan.cloud_C, scan.X_WC, range_m, 3).blocks;
  EXPECT_GT(coarse, 10.0);
  EXPECT_GT(fine, 2.0 * coarse);
}

/// What a camera 2 m over bare ground sees, clear up to `far_m`.
PointCloud over_bare_ground(double far_m) {
  PointCloud cloud;
  cloud.camera = Intrinsics{160, 120, 138.0, 79.5, 59.5};  // 60 degrees.
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const Eigen::Vector3f ray{(static_cast<float>(u) + 0.5F - 80.0F) / 138.0F,
                                (static_cast<float>(v) + 0.5F - 60.0F) / 138.0F, 1.0F};
      const float ground_m = ray.y() > 0.0F ? 2.0F / ray.y() * ray.norm() : 1e9F;
      const bool hits = ground_m < static_cast<float>(far_m);
      (hits ? cloud.hits_C : cloud.clear_C)
          .push_back((hits ? ground_m : static_cast<float>(far_m)) * ray.normalized());
    }
  }
  return cloud;
}

// Seen from 8 to 13 m off, a cell of 1.2 m that is looked at no closer than by its own width shows
// ground that is nearer than itself: such a map would end at 9 m whatever its range up to 15.
TEST(PyramidScan, frees_large_blocks_over_ground_up_to_its_range) {
  const double far_m = 14.0;
  const PointCloud cloud = over_bare_ground(25.0);
  const Lattice lattice{finest_m};
  PyramidScan pyramid{finest_m};
  for (const double yaw_rad : {0.2, 0.35, 0.5}) {
    const Vec3 ahead_W{std::cos(yaw_rad), std::sin(yaw_rad), 0.0};
    const Vec3 aside_W{-ahead_W.y(), ahead_W.x(), 0.0};
    Pose X_WC = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()} * kit::looking_along_x();
    X_WC.translation() = Vec3{0.3, -0.4, 2.0};
    const Cells cells = cells_of(pyramid.compute(cloud, X_WC, far_m, 3));
    for (double on_m = 5.0; on_m < far_m - 2.0; on_m += 0.1) {
      for (const double aside_m : {-0.4, 0.0, 0.4}) {
        const Vec3 p_W = X_WC.translation() + on_m * ahead_W + aside_m * aside_W;
        const CellKey cell = lattice.cell(p_W);
        EXPECT_TRUE(cells.find({cell.x, cell.y, cell.z}) != cells.end())
            << yaw_rad << ": " << on_m << " m on, " << aside_m << " m aside";
      }
    }
  }
}

/// Share of the points on the camera's axis, from 1 to 4 m, that a scan of open space frees.
double free_share_on_axis(PyramidScan& pyramid, int floor_level) {
  PointCloud cloud;
  cloud.camera = Intrinsics{128, 72, 110.0, 64.0, 36.0};
  for (int v = 0; v < 72; ++v) {
    for (int u = 0; u < 128; ++u) {
      const Eigen::Vector3f ray{(static_cast<float>(u) + 0.5F - 64.0F) / 110.0F,
                                (static_cast<float>(v) + 0.5F - 36.0F) / 110.0F, 1.0F};
      cloud.clear_C.push_back(8.0F * ray.normalized());
    }
  }
  Pose X_WC = kit::looking_along_x();
  X_WC.translation() = Vec3{0.02, 0.04, 1.53};
  const Cells cells = cells_of(pyramid.compute(cloud, X_WC, range_m, floor_level));
  const Lattice lattice{finest_m};
  int free = 0;
  for (int i = 0; i < 300; ++i) {
    const CellKey cell = lattice.cell(X_WC.translation() + Vec3{1.0 + 0.01 * i, 0.0, 0.0});
    free += cells.find({cell.x, cell.y, cell.z}) != cells.end() ? 1 : 0;
  }
  return free / 300.0;
}

TEST(PyramidScan, frees_more_before_a_camera_near_which_it_refines) {
  PyramidScan plain{finest_m};
  PyramidScan refining{finest_m};
  refining.refine_near_camera();
  for (const int floor_level : {1, 2, 3}) {
    const double share = free_share_on_axis(refining, floor_level);
    EXPECT_GT(share, 0.6) << floor_level;
    EXPECT_GE(share, free_share_on_axis(plain, floor_level)) << floor_level;
  }
  EXPECT_GT(free_share_on_axis(refining, 2), 1.3 * free_share_on_axis(plain, 2));
}

}  // namespace
}  // namespace flyball
