// SPDX-License-Identifier: BSD-3-Clause
#include "scans/exact_scan.h"

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include "mask_cells.h"
#include "synthetic_scans.h"
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct View {
  Pose X_WC;
  PointCloudFrame frame;
};

/// The image of a synthetic place, with noise and a few broken pixels.
DepthImage image_of(const kit::SyntheticScan& scan, kit::Place place, RandomStream& random) {
  constexpr double max_range_m = 20.0;
  DepthImage image;
  image.camera = *scan.cloud_C.camera;
  image.max_range_m = max_range_m;
  for (int pixel = 0; pixel < image.camera.width_px * image.camera.height_px; ++pixel) {
    const Vec3 ray_C{
        (pixel % image.camera.width_px - image.camera.centre_x_px) / image.camera.focal_px,
        (pixel / image.camera.width_px - image.camera.centre_y_px) / image.camera.focal_px, 1.0};
    const double d_m =
        kit::distance_m(place, scan.X_WC.translation(), scan.X_WC.linear() * ray_C.normalized());
    const double noisy_m = d_m / ray_C.norm() * (1.0 + 0.01 * (random.uniform() - 0.5));
    image.depth_m.push_back(d_m > max_range_m ? std::numeric_limits<float>::infinity()
                                              : static_cast<float>(noisy_m));
    if (random.uniform() < 0.01) {
      image.depth_m.back() =
          random.uniform() < 0.5 ? 0.0F : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return image;
}

/// One of the synthetic frames seen from anywhere: the place is moved and turned with the camera,
/// so that its walls lie askew in the lattice.
View view_of(kit::Place place, std::uint64_t number, double reach_m, double far_m, int width_px) {
  RandomStream random{7, "exact_scan_test", number};
  const auto from = kit::synthetic_scan(place, static_cast<int>(number % 10), reach_m, width_px);
  const auto any = [&](double most) { return most * (2.0 * random.uniform() - 1.0); };
  Pose X_moved = Pose::Identity();
  X_moved.linear() =
      (Eigen::AngleAxisd{any(3.1), Vec3::UnitZ()} * Eigen::AngleAxisd{any(0.4), Vec3::UnitY()} *
       Eigen::AngleAxisd{any(0.4), Vec3::UnitX()})
          .toRotationMatrix();
  X_moved.translation() = Vec3{any(far_m), any(far_m), any(3.0)};
  DepthFrame frame;
  frame.image = Deferred<DepthImage>::of(image_of(from, place, random));
  Work work;
  Registry registry;
  register_kernels(registry);
  const auto builder = registry.make<PointCloudBuilder>("depth_to_points");
  return {X_moved * from.X_WC, builder->build(frame, reach_m, work)};
}

void expect_same(const ScanMasks& ours, const ScanMasks& stock) {
  EXPECT_EQ(ours.rays, stock.rays);
  EXPECT_EQ(ours.traversals, stock.traversals);
  EXPECT_EQ(ours.updates, stock.updates);
  ASSERT_EQ(ours.bricks.size(), stock.bricks.size());
  for (std::size_t i = 0; i < ours.bricks.size(); ++i) {  // in one order
    EXPECT_TRUE(ours.bricks[i].brick == stock.bricks[i].brick);
    EXPECT_EQ(ours.bricks[i].free, stock.bricks[i].free);
    EXPECT_EQ(ours.bricks[i].hit, stock.bricks[i].hit);
  }
}

class EveryCell : public testing::TestWithParam<double> {};

TEST_P(EveryCell, is_marked_and_counted_as_if_every_ray_had_been_walked) {
  const double cell_m = GetParam();
  RayScan walked{cell_m, RayScan::Match::stock};
  for (const Simd simd : supported_simd()) {
    ExactScan exact{cell_m, simd};
    std::size_t rays = 0;
    std::size_t walks = 0;
    for (std::uint64_t number = 0; number < 40; ++number) {
      const auto place = number % 2 == 0 ? kit::Place::indoor : kit::Place::outdoor;
      const double range_m = number % 3 == 0 ? 7.0 : 20.0;
      // A knob may have changed since the points were made.
      const double reach_m = number % 7 == 0 ? 10.0 : range_m;
      const int width_px = number % 4 == 0 ? 90 : 96;
      // Far from the map's centre floats are coarse, and move the ends of cut rays.
      const double far_m = number % 5 == 0 ? 4000.0 : number % 5 == 1 ? 900.0 : 20.0;
      const View view = view_of(place, number, reach_m, far_m, width_px);
      const PointCloud& cloud_C = view.frame.cloud_C.value();
      Scan scan;
      to_world(cloud_C, view.X_WC, scan);
      scan.range_m = range_m;
      expect_same(exact.descend(view.frame, view.X_WC, range_m), walked.compute(scan));
      rays += cloud_C.hits_C.size() + cloud_C.clear_C.size();
      walks += exact.walked_rays();
    }
    EXPECT_LT(walks, rays / 10);
  }
}

INSTANTIATE_TEST_SUITE_P(ExactScan, EveryCell, testing::Values(0.15, 0.3, 0.6, 0.8, 1.2));

// Rays that begin on an edge of cells touch some of the cells around it without any length.
TEST(ExactScan, marks_what_stock_does_from_edges_and_corners_of_cells) {
  constexpr double cell_m = 0.6;
  constexpr double range_m = 7.0;
  RayScan walked{cell_m, RayScan::Match::stock};
  ExactScan exact{cell_m};
  std::size_t walks = 0;
  std::size_t rays = 0;
  for (std::uint64_t number = 0; number < 64; ++number) {
    View view = view_of(kit::Place::outdoor, number, range_m, 20.0, 96);
    const auto tiny = [&](unsigned bit) { return (number >> bit & 1U) != 0 ? 1e-17 : -3e-21; };
    view.X_WC.translation() = Vec3{tiny(0), tiny(1), (number & 4U) != 0 ? tiny(3) : 0.3};
    const PointCloud& cloud_C = view.frame.cloud_C.value();
    Scan scan;
    to_world(cloud_C, view.X_WC, scan);
    scan.range_m = range_m;
    expect_same(exact.descend(view.frame, view.X_WC, range_m), walked.compute(scan));
    walks += exact.walked_rays();
    rays += cloud_C.hits_C.size() + cloud_C.clear_C.size();
  }
  EXPECT_LT(walks, rays / 2);
}

// Floats are coarse there, and where a coordinate is rounded, a cut moves the end of a ray along
// all of them.
TEST(ExactScan, counts_as_stock_does_far_from_the_centre_of_the_map) {
  constexpr double cell_m = 0.15;
  constexpr double range_m = 7.0;
  RayScan walked{cell_m, RayScan::Match::stock};
  ExactScan exact{cell_m};
  for (std::uint64_t number = 0; number < 60; ++number) {
    const View view = view_of(kit::Place::outdoor, number, range_m, 4000.0, 128);
    Scan scan;
    to_world(view.frame.cloud_C.value(), view.X_WC, scan);
    scan.range_m = range_m;
    expect_same(exact.descend(view.frame, view.X_WC, range_m), walked.compute(scan));
  }
}

TEST(ExactScan, walks_every_ray_where_cells_are_no_wider_than_pixels) {
  RayScan walked{0.15, RayScan::Match::stock};
  ExactScan exact{0.15};
  for (const double range_m : {2.0, 20.0}) {
    const View view = view_of(kit::Place::indoor, 3, range_m, 20.0, 96);
    const PointCloud& cloud_C = view.frame.cloud_C.value();
    Scan scan;
    to_world(cloud_C, view.X_WC, scan);
    scan.range_m = range_m;
    expect_same(exact.compute(view.frame, view.X_WC, range_m), walked.compute(scan));
    const std::size_t rays = cloud_C.hits_C.size() + cloud_C.clear_C.size();
    EXPECT_EQ(exact.walked_rays() == rays, range_m > 10.0);
  }
}

}  // namespace
}  // namespace flyball
