// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/path_tracker.h"

#include "flyball/kernels/kernels.h"
#include "flyball/runtime/registry.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace {

using flyball::MissionTime;
using flyball::Path;
using flyball::PathReference;
using flyball::PoseEstimate;
using flyball::Setpoint;
using flyball::Vec3;

std::unique_ptr<flyball::PathTracker> tracker() {
  flyball::Registry registry;
  flyball::register_kernels(registry);
  return registry.make<flyball::PathTracker>("feedforward_pd");
}

PoseEstimate at(const Vec3& p_WB) {
  PoseEstimate where;
  where.X_WB.translation() = p_WB;
  return where;
}

/// Anticlockwise, radius 8 m, as a path of short chords without corners.
Path circle() {
  flyball::Trajectory trajectory;
  flyball::PolynomialPiece piece;  // cos and sin to the seventh degree, over one radian
  double factorial = 1.0;
  for (int k = 0; k < 8; ++k) {
    factorial *= k > 0 ? k : 1;
    const double sign = k % 4 < 2 ? 1.0 : -1.0;
    piece.c(k % 2, k) = 8.0 * sign / factorial;
  }
  piece.duration_s = 1.0;
  trajectory.pieces = {piece};
  return Path{trajectory};
}

TEST(FeedforwardPd, hands_on_the_reference_when_the_vehicle_is_there) {
  const Path path = Path::polyline({{0, 0, 2}, {10, 0, 2}});
  const PathReference reference{4.0, 3.0, 1.5, 0.7};
  const MissionTime now{std::chrono::seconds{5}};
  const Setpoint set = tracker()->track(path, reference, at({4, 0, 2}), now);
  EXPECT_LT((set.p_WB - Vec3{4, 0, 2}).norm(), 1e-12);
  EXPECT_LT((set.v_WB - Vec3{3, 0, 0}).norm(), 1e-12);
  EXPECT_LT((set.a_WB - Vec3{1.5, 0, 0}).norm(), 1e-12);
  EXPECT_EQ(set.yaw_rad, 0.7);
  EXPECT_EQ(set.stamp, now);
}

TEST(FeedforwardPd, feeds_the_acceleration_of_the_curve_towards_its_centre) {
  const Path path = circle();
  const double s_m = 4.0;
  const Vec3 here = path.at(s_m).p_W;
  const Setpoint set = tracker()->track(path, {s_m, 4.0, 0.0, 0.0}, at(here), {});
  EXPECT_NEAR(set.a_WB.norm(), 4.0 * 4.0 / 8.0, 0.05);
  EXPECT_LT((set.a_WB.normalized() + here.normalized()).norm(), 0.02);
}

TEST(FeedforwardPd, leads_back_to_the_path_with_bounded_speed) {
  const Path path = Path::polyline({{0, 0, 2}, {10, 0, 2}});
  const auto offset = [&](double error_m) -> Vec3 {
    const Setpoint set = tracker()->track(path, {4.0, 3.0, 0.0, 0.0}, at({4, -error_m, 2}), {});
    return set.v_WB - Vec3{3, 0, 0};
  };
  EXPECT_GT(offset(0.1).y(), 0.0);
  EXPECT_NEAR(offset(0.2).y(), 2.0 * offset(0.1).y(), 1e-12);
  EXPECT_LE(offset(50.0).norm(), 0.5 + 1e-12);
  EXPECT_GT(offset(50.0).y(), 0.49);
}

TEST(FeedforwardPd, asks_for_nothing_impossible_at_a_corner) {
  const Path path = Path::polyline({{0, 0, 2}, {10, 0, 2}, {10, 10, 2}});
  for (double s_m = 9.5; s_m <= 10.5; s_m += 0.01) {
    const Vec3 here = path.at(s_m).p_W;
    const Setpoint set = tracker()->track(path, {s_m, 0.05, 0.0, 0.0}, at(here), {});
    ASSERT_TRUE(set.a_WB.allFinite());
    EXPECT_LT(set.a_WB.norm(), 0.1);
    EXPECT_NEAR(set.v_WB.norm(), 0.05, 1e-9);
  }
}

TEST(FeedforwardPd, stays_where_it_is_without_a_path) {
  const Setpoint set = tracker()->track(Path{}, {}, at({1, 2, 3}), {});
  EXPECT_EQ(set.p_WB, (Vec3{1, 2, 3}));
  EXPECT_EQ(set.v_WB, Vec3::Zero());
}

}  // namespace
