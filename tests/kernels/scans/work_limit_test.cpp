// SPDX-License-Identifier: BSD-3-Clause
#include "scans/work_limit.h"

#include "scans/ray_scan.h"
#include "world_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(WorkLimit, finds_the_range_at_which_the_rays_cross_so_many_cells) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    Scan scan = kit::world_scan(place, 2, 7.0);
    RayScan rays{0.15, RayScan::Match::stock};
    const double all = rays.compute(scan).traversals;
    for (const double share : {0.1, 0.5, 0.9}) {
      Scan shorter = scan;
      shorter.range_m = range_within(scan, 0.15, share * all);
      EXPECT_LT(shorter.range_m, scan.range_m);
      EXPECT_NEAR(rays.compute(shorter).traversals, share * all, 0.05 * all);
    }
    EXPECT_EQ(range_within(scan, 0.15, 1.1 * all), scan.range_m);
  }
}

TEST(WorkLimit, looks_at_least_one_cell_far) {
  const Scan scan = kit::world_scan(kit::Place::indoor, 0, 7.0);
  EXPECT_EQ(range_within(scan, 0.15, 1.0), 0.15);
}

TEST(WorkLimit, leaves_a_scan_without_rays_alone) {
  Scan scan;
  scan.range_m = 7.0;
  EXPECT_EQ(range_within(scan, 0.15, 1.0), 7.0);
}

}  // namespace
}  // namespace flyball
