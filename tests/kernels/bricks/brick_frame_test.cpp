// SPDX-License-Identifier: BSD-3-Clause
//
// From masks to map, as the mapper does it for every frame.

#include "bricks/brick_map.h"
#include "bricks/brick_view.h"
#include "counting_new.h"
#include "scans/pyramid_scan.h"
#include "scans/ray_scan.h"
#include "world_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;
constexpr double finest_m = 0.15;

TEST(BrickFrame, allocates_nothing_once_warm_whatever_the_level) {
  BrickMap map{finest_m};
  map.reserve(64);
  BrickView view{map.cells()};
  RayScan rays{finest_m, RayScan::Match::stock};
  PyramidScan pyramid{finest_m};
  const Scan scan = kit::world_scan(kit::Place::indoor, 0, range_m);
  const auto image = kit::synthetic_scan(kit::Place::indoor, 0, range_m);
  const auto frame = [&](int level) {
    map.apply(rays.compute(scan).bricks);
    map.apply(pyramid.compute(image.cloud_C, image.X_WC, range_m, level).bricks);
    view.activate(level);
    return view.body_state({1.0, 0.0, 1.4}, {0.3, 0.15});
  };
  frame(0);
  const std::size_t before = allocation_count();
  for (const int level : {1, 2, 3, 0}) {
    EXPECT_EQ(frame(level), CellState::free);
  }
  EXPECT_EQ(allocation_count(), before);
}

TEST(BrickFrame, allocates_no_chunk_while_there_are_spare_ones) {
  BrickMap map{finest_m};
  map.reserve(64);
  const std::size_t bytes = map.bytes();
  RayScan rays{finest_m, RayScan::Match::stock};
  for (int frame = 0; frame < 5; ++frame) {
    map.apply(rays.compute(kit::world_scan(kit::Place::indoor, frame, range_m)).bricks);
  }
  EXPECT_GT(map.cells().chunks().size(), 4U);
  EXPECT_EQ(map.bytes(), bytes);
}

}  // namespace
}  // namespace flyball
