// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/smoother.h"
#include "flyball/runtime/registry.h"

#include "plan_scenes.h"
#include <cmath>

#include <gtest/gtest.h>

namespace {

using flyball::SmoothRequest;
using flyball::Trajectory;
using flyball::kit::GridMap;

/// Integral of the squared n-th derivative.
double effort(const Trajectory& trajectory, int n) {
  constexpr int steps = 200;
  double sum = 0.0;
  for (const auto& piece : trajectory.pieces) {
    for (int i = 0; i < steps; ++i) {
      const double t_s = piece.duration_s * (i + 0.5) / steps;
      sum += piece.derivative(n, t_s).squaredNorm() * piece.duration_s / steps;
    }
  }
  return sum;
}

TEST(MinimumJerk, keeps_jerk_smaller_and_snap_larger_than_minimum_snap) {
  // A straight way: no corner bounds the speed, so both take the same time before limits.
  SmoothRequest request;
  request.waypoints_W = {{0, 0, 1.5}, {60, 0, 1.5}};
  request.max_speed_m_s = 10.0;
  request.max_acceleration_m_s2 = 3.0;
  request.body = flyball::kit::slow_body();
  const GridMap open_space{{{0, 0, 0}, {1, 1, 1}}, 0.15};
  flyball::Registry registry;
  flyball::register_kernels(registry);
  const auto curve = [&](const char* name) {
    return registry.make<flyball::Smoother>(name)->smooth(request, open_space)->trajectory;
  };
  const Trajectory jerk = curve("minimum_jerk");
  const Trajectory snap = curve("minimum_snap");
  // Scaled to the same duration T: the n-th derivative's effort falls with T^(2n - 1).
  const double longer = jerk.duration_s() / snap.duration_s();
  EXPECT_LT(effort(jerk, 3) * std::pow(longer, 5), effort(snap, 3));
  EXPECT_LT(effort(snap, 4), effort(jerk, 4) * std::pow(longer, 7));
}

}  // namespace
