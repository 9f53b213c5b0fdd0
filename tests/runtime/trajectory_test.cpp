// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/trajectory.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// p(t) = (1 + 2 t + 3 t^2, t^7, 0)
PolynomialPiece example_piece(double duration_s) {
  PolynomialPiece piece;
  piece.c(0, 0) = 1.0;
  piece.c(0, 1) = 2.0;
  piece.c(0, 2) = 3.0;
  piece.c(1, 7) = 1.0;
  piece.duration_s = duration_s;
  return piece;
}

TEST(PolynomialPiece, has_all_its_derivatives) {
  const PolynomialPiece piece = example_piece(3.0);
  EXPECT_TRUE(piece.derivative(0, 2.0).isApprox(Vec3{17.0, 128.0, 0.0}));
  EXPECT_TRUE(piece.derivative(1, 2.0).isApprox(Vec3{14.0, 7.0 * 64.0, 0.0}));
  EXPECT_TRUE(piece.derivative(2, 2.0).isApprox(Vec3{6.0, 42.0 * 32.0, 0.0}));
  EXPECT_TRUE(piece.derivative(7, 2.0).isApprox(Vec3{0.0, 5040.0, 0.0}));
  EXPECT_EQ(piece.derivative(8, 2.0), Vec3::Zero());
}

TEST(Trajectory, runs_through_its_pieces_in_order) {
  PolynomialPiece second = example_piece(1.0);
  second.c(2, 0) = 9.0;
  const Trajectory trajectory{{example_piece(3.0), second}};
  EXPECT_EQ(trajectory.duration_s(), 4.0);
  EXPECT_EQ(trajectory.derivative(0, 2.5), trajectory.pieces[0].derivative(0, 2.5));
  EXPECT_EQ(trajectory.derivative(1, 3.5), trajectory.pieces[1].derivative(1, 0.5));
  EXPECT_EQ(trajectory.derivative(0, 3.0).z(), 9.0);  // a joint belongs to what follows
}

TEST(Trajectory, is_clamped_to_its_ends) {
  const Trajectory trajectory{{example_piece(2.0)}};
  EXPECT_EQ(trajectory.derivative(0, -1.0), trajectory.derivative(0, 0.0));
  EXPECT_EQ(trajectory.derivative(1, 99.0), trajectory.pieces[0].derivative(1, 2.0));
}

TEST(Trajectory, without_pieces_stays_at_the_origin) {
  EXPECT_EQ(Trajectory{}.duration_s(), 0.0);
  EXPECT_EQ(Trajectory{}.derivative(0, 1.0), Vec3::Zero());
}

}  // namespace
}  // namespace flyball
