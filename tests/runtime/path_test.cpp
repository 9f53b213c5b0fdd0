// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/trajectory.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double pi = 3.14159265358979323846;

/// An arc around the origin from angle `from_rad`, by the Taylor series of sine and cosine around
/// its middle: at an eighth of a circle the radius is right to 1e-8.
PolynomialPiece arc(double radius_m, double from_rad, double angle_rad) {
  PolynomialPiece around_middle;
  double factorial = 1.0;
  const double middle_rad = from_rad + 0.5 * angle_rad;
  for (int k = 0; k < 8; ++k) {
    factorial *= k > 0 ? k : 1;
    const double phase = middle_rad + 0.5 * pi * k;  // the k-th derivative
    around_middle.c.col(k) = radius_m / factorial * Vec3{std::cos(phase), std::sin(phase), 0.0};
  }
  PolynomialPiece piece;  // the same polynomial, in t = angle + half
  piece.duration_s = angle_rad;
  factorial = 1.0;
  for (int k = 0; k < 8; ++k) {
    factorial *= k > 0 ? k : 1;
    piece.c.col(k) = around_middle.derivative(k, -0.5 * angle_rad) / factorial;
  }
  return piece;
}

Trajectory circle(double radius_m) {
  Trajectory trajectory;
  for (int i = 0; i < 8; ++i) {
    trajectory.pieces.push_back(arc(radius_m, 0.25 * pi * i, 0.25 * pi));
  }
  return trajectory;
}

/// Straight from a to b, at rest at both ends: 35 t^4 - 84 t^5 + 70 t^6 - 20 t^7.
PolynomialPiece stop_to_stop(const Vec3& a, const Vec3& b) {
  PolynomialPiece piece;
  piece.duration_s = 1.0;
  piece.c.col(0) = a;
  const double blend[] = {35.0, -84.0, 70.0, -20.0};
  for (int k = 4; k < 8; ++k) {
    piece.c.col(k) = blend[k - 4] * (b - a);
  }
  return piece;
}

TEST(Path, of_a_circle_has_its_length_and_curvature) {
  for (const double radius_m : {1.0, 5.0}) {
    const Path path{circle(radius_m), 0.05};
    // a chord of h is short by h^2 / (24 R^2): 1e-4 at 1 m
    EXPECT_NEAR(path.length_m(), 2.0 * pi * radius_m, 1.1e-4 * 2.0 * pi * radius_m);
    for (const Path::Sample& sample : path.samples()) {
      EXPECT_NEAR(sample.curvature_1_m, 1.0 / radius_m, 2e-3 / radius_m) << sample.s_m;
      EXPECT_NEAR(sample.p_W.norm(), radius_m, 1e-6 * radius_m);
      EXPECT_NEAR(sample.tangent_W.norm(), 1.0, 1e-12);
      EXPECT_NEAR(sample.tangent_W.dot(sample.p_W), 0.0, 1e-3 * radius_m);
    }
  }
}

TEST(Path, has_no_chord_longer_than_its_step_and_ends_exactly) {
  for (const double step_m : {0.02, 0.05, 0.5}) {
    const Trajectory trajectory = circle(2.0);
    const Path path{trajectory, step_m};
    for (std::size_t i = 1; i < path.samples().size(); ++i) {
      const auto& a = path.samples()[i - 1];
      const auto& b = path.samples()[i];
      EXPECT_LE((b.p_W - a.p_W).norm(), step_m);
      EXPECT_NEAR(b.s_m - a.s_m, (b.p_W - a.p_W).norm(), 1e-12);
      EXPECT_GT(b.s_m, a.s_m);
    }
    EXPECT_EQ(path.samples().front().p_W, trajectory.derivative(0, 0.0));
    EXPECT_EQ(path.samples().back().p_W, trajectory.derivative(0, trajectory.duration_s()));
  }
}

TEST(Path, at_clamps_to_the_ends_and_is_linear_between_samples) {
  const Path path = Path::polyline({Vec3::Zero(), Vec3{3.0, 4.0, 0.0}}, 0.3);
  EXPECT_EQ(path.at(-1.0).p_W, Vec3::Zero());
  EXPECT_EQ(path.at(99.0).s_m, path.length_m());
  EXPECT_TRUE(path.at(99.0).p_W.isApprox(Vec3{3.0, 4.0, 0.0}));
  for (double s_m = 0.0; s_m < 5.0; s_m += 0.0371) {
    EXPECT_NEAR((path.at(s_m).p_W - s_m / 5.0 * Vec3{3.0, 4.0, 0.0}).norm(), 0.0, 1e-12);
    EXPECT_EQ(path.at(s_m).s_m, s_m);
  }
}

TEST(Path, polyline_corners_have_infinite_curvature_and_the_rest_none) {
  const Path path = Path::polyline(
      {Vec3::Zero(), Vec3{1.0, 0.0, 0.0}, Vec3{2.0, 0.0, 0.0}, Vec3{2.0, 1.0, 0.0}}, 0.05);
  int corners = 0;
  for (const Path::Sample& sample : path.samples()) {
    const bool is_corner = std::abs(sample.s_m - 2.0) < 1e-9;  // not the way-point on the line
    EXPECT_EQ(sample.curvature_1_m, is_corner ? INFINITY : 0.0) << sample.s_m;
    corners += is_corner ? 1 : 0;
    EXPECT_EQ(path.at(sample.s_m).curvature_1_m, sample.curvature_1_m);
  }
  EXPECT_EQ(corners, 1);
  EXPECT_NEAR(path.length_m(), 3.0, 1e-12);
  for (const double off_m : {1e-6, 0.01, 0.04}) {
    EXPECT_EQ(path.at(2.0 - off_m).curvature_1_m, 0.0);
    EXPECT_EQ(path.at(2.0 + off_m).curvature_1_m, 0.0);
    EXPECT_EQ(path.at(2.0 - off_m).tangent_W, Vec3::UnitX());
    EXPECT_EQ(path.at(2.0 + off_m).tangent_W, Vec3::UnitY());
  }
}

TEST(Path, there_and_back_turns_at_a_corner_without_losing_its_tangent) {
  const Path path = Path::polyline({Vec3::Zero(), Vec3::UnitX(), Vec3::Zero()}, 0.05);
  for (double s_m = 0.0; s_m <= 2.0; s_m += 0.003) {
    EXPECT_EQ(path.at(s_m).tangent_W.x(), s_m < 1.0 - 1e-9 ? 1.0 : -1.0) << s_m;
  }
}

TEST(Path, a_trajectory_that_stops_to_turn_has_a_corner_and_no_false_curvature) {
  const Vec3 corner{2.0, 0.0, 1.0};
  const Trajectory trajectory{
      {stop_to_stop(Vec3::Zero(), corner), stop_to_stop(corner, Vec3{2.0, 3.0, 1.0})}};
  const Path path{trajectory, 0.05};
  EXPECT_NEAR(path.length_m(), corner.norm() + 3.0, 1e-3);
  int corners = 0;
  for (const Path::Sample& sample : path.samples()) {
    if (std::isinf(sample.curvature_1_m)) {
      ++corners;
      EXPECT_NEAR((sample.p_W - corner).norm(), 0.0, 1e-3);
    } else {
      EXPECT_NEAR(sample.curvature_1_m, 0.0, 1e-6) << sample.s_m;
    }
  }
  EXPECT_EQ(corners, 1);
}

TEST(Path, a_stop_on_a_straight_line_is_no_corner) {
  const Trajectory trajectory{{stop_to_stop(Vec3::Zero(), Vec3::UnitX()),
                               stop_to_stop(Vec3::UnitX(), 3.0 * Vec3::UnitX())}};
  const Path path{trajectory, 0.05};
  EXPECT_NEAR(path.length_m(), 3.0, 1e-9);
  for (const Path::Sample& sample : path.samples()) {
    EXPECT_NEAR(sample.curvature_1_m, 0.0, 1e-6);
  }
}

TEST(Path, of_nothing_is_empty_and_of_a_hover_is_one_place) {
  EXPECT_TRUE((Path{Trajectory{}, 0.05}.empty()));
  EXPECT_TRUE(Path::polyline({}).empty());
  const Path hover{Trajectory{{stop_to_stop(Vec3::UnitZ(), Vec3::UnitZ())}}, 0.05};
  EXPECT_EQ(hover.length_m(), 0.0);
  EXPECT_EQ(hover.at(1.0).p_W, Vec3::UnitZ());
}

TEST(Path, joined_where_the_tail_goes_on_smoothly_has_no_corner) {
  const Path whole{circle(5.0), 0.05};
  const Path tail{Trajectory{{arc(5.0, 0.5 * pi, 0.25 * pi)}}, 0.05};
  const double quarter_m = 0.25 * whole.length_m();
  const Path path = Path::joined(whole, 1.0, quarter_m, tail);
  EXPECT_NEAR(path.length_m(), quarter_m - 1.0 + tail.length_m(), 1e-3);
  EXPECT_EQ(path.samples().front().p_W, whole.at(1.0).p_W);
  EXPECT_TRUE(path.samples().back().p_W.isApprox(tail.samples().back().p_W));
  for (std::size_t i = 1; i < path.samples().size(); ++i) {
    const auto& a = path.samples()[i - 1];
    const auto& b = path.samples()[i];
    EXPECT_NEAR(b.curvature_1_m, 0.2, 2e-3) << b.s_m;
    EXPECT_LE((b.p_W - a.p_W).norm(), 0.05);
    EXPECT_LE((b.tangent_W - a.tangent_W).norm(), 0.2 * 0.05 + 1e-3);
  }
}

TEST(Path, joined_with_a_kink_has_a_corner_exactly_there) {
  const Path head = Path::polyline({Vec3::Zero(), 4.0 * Vec3::UnitX()});
  const Path tail = Path::polyline({Vec3{3.0, 0.0, 0.0}, Vec3{3.0, 2.0, 0.0}});
  const Path path = Path::joined(head, 0.5, 3.0, tail);
  EXPECT_NEAR(path.length_m(), 4.5, 1e-9);
  EXPECT_TRUE(path.at(2.5 - 1e-6).tangent_W.isApprox(Vec3::UnitX()));
  EXPECT_TRUE(path.at(2.5 + 1e-6).tangent_W.isApprox(Vec3::UnitY()));
  for (const Path::Sample& sample : path.samples()) {
    EXPECT_EQ(std::isinf(sample.curvature_1_m), std::abs(sample.s_m - 2.5) < 1e-6) << sample.s_m;
  }
}

TEST(Path, joined_over_a_gap_goes_straight_across) {
  const Path head = Path::polyline({Vec3::Zero(), Vec3::UnitX()});
  const Path tail = Path::polyline({Vec3{1.0, 0.02, 0.0}, Vec3{2.0, 0.02, 0.0}});
  const Path path = Path::joined(head, 0.0, 1.0, tail);
  EXPECT_NEAR(path.length_m(), 2.02, 1e-9);
  EXPECT_TRUE(std::isinf(path.at(1.0).curvature_1_m));
}

TEST(Path, joined_from_a_corner_starts_in_its_leaving_direction) {
  const Path head = Path::polyline({Vec3::Zero(), Vec3::UnitX(), Vec3{1.0, 1.0, 0.0}});
  const Path path = Path::joined(head, 1.0, 2.0, Path{});
  EXPECT_EQ(path.samples().front().curvature_1_m, 0.0);  // or nobody would ever leave
  EXPECT_EQ(path.samples().front().tangent_W, Vec3::UnitY());
  EXPECT_NEAR(path.length_m(), 1.0, 1e-12);
}

TEST(Path, joined_with_nothing_left_of_the_head_is_the_tail) {
  const Path tail = Path::polyline({Vec3::UnitX(), 2.0 * Vec3::UnitX()});
  EXPECT_EQ(Path::joined(Path{}, 0.0, 1.0, tail).length_m(), tail.length_m());
  const Path head = Path::polyline({Vec3::Zero(), Vec3::UnitX()});
  const Path path = Path::joined(head, 1.0, 1.0, tail);
  EXPECT_NEAR(path.length_m(), 1.0, 1e-12);
  EXPECT_EQ(path.samples().front().curvature_1_m, 0.0);
}

}  // namespace
}  // namespace flyball
