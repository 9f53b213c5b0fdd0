// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/coverage_planner.h"
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace {

using flyball::CoverageRequest;
using flyball::Vec3;

std::unique_ptr<flyball::CoveragePlanner> lawnmower() {
  flyball::Registry registry;
  flyball::register_kernels(registry);
  return registry.make<flyball::CoveragePlanner>("lawnmower");
}

CoverageRequest field() {
  CoverageRequest request;
  request.corner_W = {10.0, 20.0, 15.0};
  request.length_m = 100.0;
  request.width_m = 60.0;
  request.lanes = 3;
  request.start_W = {0.0, 0.0, 15.0};
  request.end_W = {0.0, 5.0, 15.0};
  return request;
}

/// Least distance of a place from the polygon.
double distance_m(const std::vector<Vec3>& points_W, const Vec3& p_W) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points_W.size(); ++i) {
    const Vec3 edge = points_W[i + 1] - points_W[i];
    const double u = std::clamp((p_W - points_W[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    least_m = std::min(least_m, (points_W[i] + u * edge - p_W).norm());
  }
  return least_m;
}

TEST(Lawnmower, comes_within_half_a_lane_of_every_place_of_the_area) {
  for (const int lanes : {1, 2, 3, 8}) {
    CoverageRequest request = field();
    request.lanes = lanes;
    const auto path = lawnmower()->cover(request);
    ASSERT_TRUE(path) << path.error().message;
    for (double x_m = 10.0; x_m <= 110.0; x_m += 5.0) {
      for (double y_m = 20.0; y_m <= 80.0; y_m += 2.5) {
        EXPECT_LE(distance_m(path->waypoints_W, {x_m, y_m, 15.0}), 30.0 / lanes + 1e-9);
      }
    }
  }
}

TEST(Lawnmower, begins_at_the_start_ends_at_the_end_and_stays_at_its_height) {
  const auto path = lawnmower()->cover(field());
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_EQ(path->waypoints_W.front(), field().start_W);
  EXPECT_EQ(path->waypoints_W.back(), field().end_W);
  for (const Vec3& p_W : path->waypoints_W) {
    EXPECT_EQ(p_W.z(), 15.0);
  }
  EXPECT_DOUBLE_EQ(path->out_m, (path->waypoints_W[1] - field().start_W).norm());
}

TEST(Lawnmower, takes_the_corner_from_which_the_path_is_shortest) {
  const auto length_from = [](const Vec3& start_W, const Vec3& end_W) {
    CoverageRequest request = field();
    request.start_W = start_W;
    request.end_W = end_W;
    return flyball::length_m(lawnmower()->cover(request)->waypoints_W);
  };
  const double lanes_m = 3 * 100.0 + 2 * 20.0;
  const Vec3 low{10.0, 30.0, 15.0};
  const Vec3 high{110.0, 70.0, 15.0};
  EXPECT_NEAR(length_from(low, high), lanes_m, 1e-9);
  EXPECT_NEAR(length_from(high, low), lanes_m, 1e-9);
  const Vec3 low_far{110.0, 30.0, 15.0};
  const Vec3 high_near{10.0, 70.0, 15.0};
  EXPECT_NEAR(length_from(low_far, high_near), lanes_m, 1e-9);
}

TEST(Lawnmower, counts_the_waypoints_of_the_four_paths_that_it_compares) {
  CoverageRequest request = field();
  request.lanes = 5;
  EXPECT_EQ(lawnmower()->cover(request)->work.count("waypoints"), 4.0 * (2.0 * 5.0 + 2.0));
}

TEST(Lawnmower, refuses_an_area_without_extent) {
  CoverageRequest request = field();
  request.lanes = 0;
  EXPECT_FALSE(lawnmower()->cover(request));
  request = field();
  request.width_m = 0.0;
  const auto path = lawnmower()->cover(request);
  ASSERT_FALSE(path);
  EXPECT_EQ(path.error().code, flyball::ErrorCode::invalid_input);
  request = field();
  request.end_W.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lawnmower()->cover(request));
}

}  // namespace
