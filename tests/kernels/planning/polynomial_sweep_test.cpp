// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/polynomial_sweep.h"

#include "bricks/brick_map.h"
#include "bricks/brick_view.h"
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Cylinder body{0.3, 0.15};
constexpr double tolerance_m = 0.002;

/// Single occupied cells in an open space of 16 x 16 x 8 m.
BrickMap scattered_map() {
  BrickMap map{0.2};
  std::mt19937_64 generator{3};
  std::vector<BrickMasks> changes;
  for (int i = 0; i < 20 * 20 * 10; ++i) {
    const std::uint64_t hit =
        generator() % 15 == 0 ? std::uint64_t{1} << generator() % 64 : std::uint64_t{0};
    constexpr int middle = Lattice::half_keys / 4;
    changes.push_back(
        {{middle + i % 20 - 10, middle + i / 20 % 20 - 10, middle + i / 400 - 5}, ~hit, hit});
  }
  map.apply(changes);
  return map;
}

PolynomialPiece random_piece(std::mt19937& generator) {
  std::uniform_real_distribution<double> unit{-1.0, 1.0};
  PolynomialPiece piece;
  piece.duration_s = 1.0 + 0.5 * unit(generator);
  double share = 5.0;
  for (int k = 0; k < 8; ++k) {
    piece.c.col(k) = share * Vec3{unit(generator), unit(generator), 0.4 * unit(generator)};
    share *= k == 0 ? 0.4 : 0.6;
  }
  return piece;
}

/// At places that are a centimetre apart on the mean, and less than four anywhere.
bool hits_in_samples(const OccupancyView& map, const PolynomialPiece& piece, const Cylinder& of) {
  double length_m = 0.0;
  for (int i = 0; i < 200; ++i) {
    length_m += (piece.derivative(0, piece.duration_s * (i + 1) / 200) -
                 piece.derivative(0, piece.duration_s * i / 200))
                    .norm();
  }
  const int count = 1 + static_cast<int>(length_m / 0.01);
  for (int i = 0; i <= count; ++i) {
    const Vec3 p = piece.derivative(0, piece.duration_s * i / count);
    if (map.segment_hits(p, p, of)) {
      return true;
    }
  }
  return false;
}

TEST(PolynomialSweep, misses_nothing_that_the_body_hits) {
  const BrickMap map = scattered_map();
  const BrickView view{map.cells()};
  std::mt19937 generator{5};
  int hit = 0;
  int free = 0;
  for (int i = 0; i < 400; ++i) {
    const PolynomialPiece piece = random_piece(generator);
    const bool hits = sweep_hits(view, piece, body, tolerance_m);
    if (hits_in_samples(view, piece, body)) {
      ++hit;
      ASSERT_TRUE(hits);
    }
    free += hits ? 0 : 1;
  }
  EXPECT_GT(hit, 50);
  EXPECT_GT(free, 50);
}

TEST(PolynomialSweep, is_stopped_only_by_what_is_nearer_than_the_tolerance) {
  const BrickMap map = scattered_map();
  const BrickView view{map.cells()};
  std::mt19937 generator{7};
  constexpr double step_m = 0.02;  // half of the way between two samples, see hits_in_samples
  const Cylinder wider{body.radius_m + 2.0 * tolerance_m + step_m,
                       body.half_height_m + 2.0 * tolerance_m + step_m};
  int stopped = 0;
  for (int i = 0; i < 400; ++i) {
    const PolynomialPiece piece = random_piece(generator);
    if (sweep_hits(view, piece, body, tolerance_m)) {
      ++stopped;
      ASSERT_TRUE(hits_in_samples(view, piece, wider));
    }
  }
  EXPECT_GT(stopped, 50);
}

TEST(PolynomialSweep, passes_beside_a_cube_by_the_millimetres_that_there_are) {
  BrickMap map{0.2};
  const CellKey cell = map.lattice().cell({1.1, 0.1, 0.1});  // 1.0 to 1.2, 0 to .2, 0 to .2
  map.apply({{cell.above(brick_level), 0, std::uint64_t{1} << bit_in_brick(cell)}});
  const BrickView view{map.cells()};
  // A parabola over x whose lowest place, above the cube's far side, is at `low_m`.
  const auto bend = [&](double low_m) {
    PolynomialPiece piece;
    piece.duration_s = 2.2;
    piece.c.col(0) = Vec3{0.0, low_m + 1.21, 0.1};
    piece.c.col(1) = Vec3{1.0, -2.2, 0.0};
    piece.c.col(2) = Vec3{0.0, 1.0, 0.0};
    return piece;
  };
  EXPECT_TRUE(sweep_hits(view, bend(0.2 + body.radius_m - 0.005), body, tolerance_m));
  EXPECT_FALSE(sweep_hits(view, bend(0.2 + body.radius_m + 0.005), body, tolerance_m));
}

TEST(PolynomialSweep, calls_a_piece_blocked_that_is_not_finite) {
  const BrickMap map{0.2};
  const BrickView view{map.cells()};
  PolynomialPiece piece;
  piece.duration_s = 1.0;
  EXPECT_FALSE(sweep_hits(view, piece, body));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    piece.c(1, 5) = bad;
    EXPECT_TRUE(sweep_hits(view, piece, body));
  }
}

}  // namespace
}  // namespace flyball
