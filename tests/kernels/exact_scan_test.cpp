// SPDX-License-Identifier: BSD-3-Clause
#include "../../kernels/src/bricks/exact_scan.h"

#include "flyball/runtime/random.h"

#include "mask_cells.h"
#include "synthetic_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct View {
  PointCloud cloud_C;
  Pose X_WC;
  Scan scan;
};

/// One of the synthetic frames with noise along its rays, seen from anywhere: the place is moved
/// and turned with the camera, so that its walls lie askew in the lattice.
View view_of(kit::Place place, std::uint64_t number, double range_m, double far_m, int width_px) {
  RandomStream random{7, "exact_scan_test", number};
  const kit::SyntheticScan from =
      kit::synthetic_scan(place, static_cast<int>(number % 10), range_m, width_px);
  View view{from.cloud_C, from.X_WC, {}};
  for (Eigen::Vector3f& p_C : view.cloud_C.hits_C) {
    p_C *= static_cast<float>(1.0 + 0.01 * (random.uniform() - 0.5));
  }
  const auto any = [&](double most) { return most * (2.0 * random.uniform() - 1.0); };
  Pose X_moved = Pose::Identity();
  X_moved.linear() =
      (Eigen::AngleAxisd{any(3.1), Vec3::UnitZ()} * Eigen::AngleAxisd{any(0.4), Vec3::UnitY()} *
       Eigen::AngleAxisd{any(0.4), Vec3::UnitX()})
          .toRotationMatrix();
  X_moved.translation() = Vec3{any(far_m), any(far_m), any(3.0)};
  view.X_WC = X_moved * from.X_WC;
  to_world(view.cloud_C, view.X_WC, view.scan);
  view.scan.range_m = range_m;
  return view;
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
      const View view = view_of(place, number, range_m, number % 5 == 0 ? 900.0 : 20.0, 96);
      expect_same(exact.compute(view.cloud_C, view.X_WC, range_m), walked.compute(view.scan));
      rays += view.scan.hits_W.size() + view.scan.clear_W.size();
      walks += exact.walked_rays();
    }
    EXPECT_LT(walks, rays / 10);
  }
}

INSTANTIATE_TEST_SUITE_P(ExactScan, EveryCell, testing::Values(0.15, 0.3, 0.6, 0.8, 1.2));

}  // namespace
}  // namespace flyball
