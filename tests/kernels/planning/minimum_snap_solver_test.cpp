// SPDX-License-Identifier: BSD-3-Clause
#include "planning/minimum_snap_solver.h"

#include "flyball/runtime/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace {

using flyball::SnapKnot;
using flyball::Vec3;

SnapKnot knot(double x_m, bool is_fixed) {
  return {{x_m, 0, 0}, Vec3::UnitX(), Vec3::Zero(), is_fixed};
}

/// Midpoint rule over the squared fourth derivative.
double snap_of(const std::vector<SnapKnot>& knots, const std::vector<double>& durations_s) {
  double sum = 0.0;
  constexpr int steps = 400;
  for (std::size_t i = 0; i < durations_s.size(); ++i) {
    const auto piece = flyball::piece_between(knots[i], knots[i + 1], durations_s[i]);
    for (int k = 0; k < steps; ++k) {
      const double t = durations_s[i] * (k + 0.5) / steps;
      sum += piece.derivative(4, t).squaredNorm() * durations_s[i] / steps;
    }
  }
  return sum;
}

TEST(MinimumSnapSolver, joins_its_pieces_with_the_derivatives_of_the_knots) {
  const SnapKnot from{{1, 2, 3}, Vec3{1, 1, 0}.normalized(), {2.0, -0.5, 0.3}, true};
  const SnapKnot to{{6, 4, 3}, Vec3{0, 1, 0}, {1.5, 0.4, -0.2}, true};
  const auto piece = flyball::piece_between(from, to, 3.0);
  EXPECT_LT((piece.derivative(0, 0.0) - from.p_W).norm(), 1e-12);
  EXPECT_LT((piece.derivative(0, 3.0) - to.p_W).norm(), 1e-11);
  for (int n = 1; n <= 3; ++n) {
    EXPECT_LT((piece.derivative(n, 0.0) - from.along[n - 1] * from.direction_W).norm(), 1e-11);
    EXPECT_LT((piece.derivative(n, 3.0) - to.along[n - 1] * to.direction_W).norm(), 1e-10);
  }
}

TEST(MinimumSnapSolver, finds_the_known_speed_between_two_equal_rests) {
  // Rest to rest over 2 m in 2 s is p = 2 (35 u^4 - 84 u^5 + 70 u^6 - 20 u^7); the knot in the
  // middle must not change it: v = 2 * 140 (u^3 - 3 u^4 + 3 u^5 - u^6) / 2 s at u = 1/2.
  std::vector<SnapKnot> knots{knot(0, true), knot(1, false), knot(2, true)};
  flyball::minimise(4, knots, {1.0, 1.0});
  EXPECT_NEAR(knots[1].along[0], 140.0 / 64.0, 1e-4);
  EXPECT_NEAR(knots[1].along[1], 0.0, 1e-4);
}

TEST(MinimumSnapSolver, finds_the_minimum_jerk_motion_between_two_places) {
  // Flash and Hogan's p = 2 (10 u^3 - 15 u^4 + 6 u^5) over 2 m in 2 s, whose jerk is
  // 60 - 360 u + 360 u^2 times 2 m / (2 s)^3: 15 at both ends, -7.5 in the middle.
  std::vector<SnapKnot> knots{knot(0, true), knot(1, false), knot(2, true)};
  knots.front().along.z() = knots.back().along.z() = 15.0;
  flyball::minimise(3, knots, {1.0, 1.0});
  EXPECT_NEAR(knots[1].along[0], 1.875, 1e-4);
  EXPECT_NEAR(knots[1].along[1], 0.0, 1e-4);
  EXPECT_NEAR(knots[1].along[2], -7.5, 1e-3);
}

TEST(MinimumSnapSolver, leaves_no_better_neighbour) {
  flyball::RandomStream random{5, "solver"};
  std::vector<SnapKnot> knots;
  std::vector<double> durations_s;
  Vec3 p = Vec3::Zero();
  for (int i = 0; i < 7; ++i) {
    Vec3 direction{1.0, random.uniform(-1, 1), random.uniform(-0.3, 0.3)};
    direction.normalize();
    p += random.uniform(1.0, 4.0) * direction;
    knots.push_back({p, direction, Vec3::Zero(), i == 0 || i == 6});
    if (i > 0) {
      durations_s.push_back(random.uniform(0.5, 2.0));
    }
  }
  flyball::minimise(4, knots, durations_s);
  const double least = snap_of(knots, durations_s);
  for (std::size_t i = 1; i < 6; ++i) {
    for (int n = 0; n < 3; ++n) {
      for (const double change : {-0.05, 0.05}) {
        auto other = knots;
        other[i].along[n] += change * (1.0 + std::abs(other[i].along[n]));
        EXPECT_GT(snap_of(other, durations_s), least);
      }
    }
  }
}

TEST(MinimumSnapSolver, keeps_sane_beside_a_piece_that_is_ten_thousand_times_shorter) {
  std::vector<SnapKnot> knots{knot(0, true), knot(300, false), knot(300.01, false),
                              knot(310, true)};
  knots[1].along = knots[2].along = {5.0, 0.0, 0.0};
  flyball::minimise(4, knots, {60.0, 0.002, 4.0});
  for (const auto& k : knots) {
    EXPECT_TRUE(k.along.allFinite());
    EXPECT_LT(std::abs(k.along[0]), 20.0);
  }
  EXPECT_NEAR(knots[1].along[0], 5.0, 1.0);
}

TEST(MinimumSnapSolver, knows_how_far_a_knot_reaches) {
  SnapKnot k = knot(0, true);
  double reach_m = 0.0;
  k.along = {7.0, 0.0, 0.0};
  EXPECT_TRUE(flyball::control_reach_m(k, 1.0, true, reach_m));
  EXPECT_NEAR(reach_m, 3.0, 1e-12);
  k.along = {7.0, 42.0, 0.0};  // speeding up: reaches farther ahead, less far back
  EXPECT_TRUE(flyball::control_reach_m(k, 1.0, true, reach_m));
  EXPECT_NEAR(reach_m, 6.0, 1e-12);
  EXPECT_FALSE(flyball::control_reach_m(k, 1.0, false, reach_m));
  k.along = {-1.0, 0.0, 0.0};
  EXPECT_FALSE(flyball::control_reach_m(k, 1.0, true, reach_m));
}

TEST(MinimumSnapSolver, gives_the_same_bits_on_every_processor) {
  // Durations are powers of two, so that the C library's pow, which is not ours, is exact.
  std::vector<SnapKnot> knots{{{0, 0, 1}, Vec3{3, 4, 0} / 5, {1.7, 0.2, 0}, true},
                              {{5, 3, 1.5}, Vec3{4, 3, 0} / 5, Vec3::Zero(), false},
                              {{9, 11, 1.2}, Vec3{-3, 4, 0} / 5, Vec3::Zero(), false},
                              {{6, 18, 2}, Vec3{0, 5, 12} / 13, {0.9, 0, 0.1}, true}};
  flyball::minimise(4, knots, {2.0, 4.0, 2.0});
  const auto piece = flyball::piece_between(knots[1], knots[2], 4.0);
  const auto is = [](const Vec3& seen, double x, double y, double z) {
    return seen.x() == x && seen.y() == y && seen.z() == z;
  };
  // As an x86-64 computes them.
  EXPECT_TRUE(
      is(knots[1].along, 0x1.20479f6f9349ap+2, 0x1.498334bd8a349p-1, -0x1.76c4a34016f3fp+1));
  EXPECT_TRUE(
      is(knots[2].along, 0x1.d5ad6af0cc288p+2, 0x1.6186955f6938cp-1, -0x1.44ca834eba9ecp+3));
  EXPECT_TRUE(is(piece.c.col(5), -0x1.910e4eca6cd7p-3, 0x1.65ff134f4527dp-2, 0x1.93333333332cfp-6));
  EXPECT_TRUE(
      is(piece.c.col(7), -0x1.5242d2f1fff8p-9, 0x1.21194ae4b6107p-8, 0x1.7ffffffffffa1p-12));
}

}  // namespace
