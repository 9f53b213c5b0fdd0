// SPDX-License-Identifier: BSD-3-Clause
#include "planning/minimum_snap_solver.h"

#include "flyball/runtime/assert.h"

#include <cmath>
#include <cstddef>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace flyball {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix3 = Eigen::Matrix3d;

// A small weight that pulls the solution towards the first guess. Snap falls with the seventh power
// of the duration (jerk with the fifth), so a long piece weighs almost nothing beside a short one,
// and unknowns that only the long piece determines would be lost in rounding.
constexpr double ridge = 1e-6;

/// k! / (k - n)!: the factor that n derivatives bring to t^k.
double derivative_factor(int k, int n) {
  double factor = 1.0;
  for (int i = 0; i < n; ++i) {
    factor *= k - i;
  }
  return factor;
}

/// From coefficients to [p, v, a, j] at both ends, for unit duration.
Matrix8 end_derivatives() {
  Matrix8 rows = Matrix8::Zero();
  for (int n = 0; n < 4; ++n) {
    rows(n, n) = derivative_factor(n, n);
    for (int k = n; k < 8; ++k) {
      rows(4 + n, k) = derivative_factor(k, n);
    }
  }
  return rows;
}

/// From [p, v, a, j] at both ends to coefficients, for unit duration.
const Matrix8& coefficients_from_ends() {
  static const Matrix8 inverse = end_derivatives().inverse();
  return inverse;
}

Matrix8 form_of_coefficients(int n) {
  Matrix8 form = Matrix8::Zero();
  for (int i = n; i < 8; ++i) {
    for (int k = n; k < 8; ++k) {
      form(i, k) = derivative_factor(i, n) * derivative_factor(k, n) / (i + k - 2 * n + 1);
    }
  }
  return form;
}

Matrix8 form_of_ends(int n) {
  // Lazily, each coefficient is summed in order. Eigen's product for large matrices sums the last
  // rows in another order where a processor has more registers, as 64-bit Arm does.
  const Matrix8 ends_to_rows = coefficients_from_ends().transpose();
  const Matrix8 of_coefficients = ends_to_rows.lazyProduct(form_of_coefficients(n));
  return of_coefficients.lazyProduct(coefficients_from_ends());
}

/// The squared n-th derivative as a quadratic form of [p, v, a, j] at both ends, for unit duration.
const Matrix8& squared_derivative(int n) {
  static const Matrix8 jerk = form_of_ends(3);
  static const Matrix8 snap = form_of_ends(4);
  return n == 3 ? jerk : snap;
}

Vec3 powers(double duration_s) {
  return {duration_s, duration_s * duration_s, duration_s * duration_s * duration_s};
}

/// H x = b, one row of 3x3 blocks per knot.
struct NormalEquations {
  explicit NormalEquations(std::size_t knots)
      : diagonal(knots, Matrix3::Zero()), above(knots, Matrix3::Zero()), b(knots, Vec3::Zero()) {}
  std::vector<Matrix3> diagonal;
  std::vector<Matrix3> above;  ///< Couples a knot with the next.
  std::vector<Vec3> b;
};

/// @param n  The derivative that is kept small.
void add_piece(NormalEquations& equations,
               int n,
               std::size_t i,
               const std::vector<SnapKnot>& knots,
               double duration_s) {
  FLYBALL_ASSERT(duration_s > 0.0, "duration_s=%g", duration_s);
  const SnapKnot& from = knots[i];
  const SnapKnot& to = knots[i + 1];
  const Matrix8& q = squared_derivative(n);
  const Vec3 move = to.p_W - from.p_W;
  const Eigen::DiagonalMatrix<double, 3> scale{powers(duration_s)};
  const double weight = std::pow(duration_s, 1 - 2 * n);
  equations.diagonal[i] += weight * (scale * q.block<3, 3>(1, 1) * scale);
  equations.diagonal[i + 1] += weight * (scale * q.block<3, 3>(5, 5) * scale);
  equations.above[i] +=
      weight * from.direction_W.dot(to.direction_W) * (scale * q.block<3, 3>(1, 5) * scale);
  equations.b[i] -= weight * from.direction_W.dot(move) * (scale * q.block<3, 1>(1, 4));
  equations.b[i + 1] -= weight * to.direction_W.dot(move) * (scale * q.block<3, 1>(5, 4));
}

/// Known derivatives leave the equations; free ones get the pull to their first guess.
void constrain(NormalEquations& equations, const std::vector<SnapKnot>& knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!knots[i].is_fixed) {
      const Vec3 pull = ridge * equations.diagonal[i].diagonal();
      equations.diagonal[i].diagonal() += pull;
      equations.b[i] += pull.cwiseProduct(knots[i].along);
      continue;
    }
    if (i > 0) {
      equations.b[i - 1] -= equations.above[i - 1] * knots[i].along;
      equations.above[i - 1].setZero();
    }
    if (i + 1 < knots.size()) {
      equations.b[i + 1] -= equations.above[i].transpose() * knots[i].along;
      equations.above[i].setZero();
    }
    equations.diagonal[i].setIdentity();
    equations.b[i] = knots[i].along;
  }
}

/// Block elimination; the matrix is symmetric and positive definite.
void solve(NormalEquations& equations, std::vector<SnapKnot>& knots) {
  auto& [diagonal, above, b] = equations;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const Eigen::LDLT<Matrix3> pivot{diagonal[i]};
    const Matrix3 factor = pivot.solve(above[i]).transpose();
    diagonal[i + 1] -= factor * above[i];
    b[i + 1] -= factor * b[i];
  }
  for (std::size_t i = knots.size(); i-- > 0;) {
    if (i + 1 < knots.size()) {
      b[i] -= above[i] * knots[i + 1].along;
    }
    knots[i].along = diagonal[i].ldlt().solve(b[i]);
  }
}

}  // namespace

void minimise(int derivative,
              std::vector<SnapKnot>& knots,
              const std::vector<double>& durations_s) {
  FLYBALL_ASSERT(derivative == 3 || derivative == 4, "derivative=%d", derivative);
  FLYBALL_ASSERT(durations_s.size() + 1 == knots.size(), "%zu knots, %zu durations", knots.size(),
                 durations_s.size());
  NormalEquations equations{knots.size()};
  for (std::size_t i = 0; i < durations_s.size(); ++i) {
    add_piece(equations, derivative, i, knots, durations_s[i]);
  }
  constrain(equations, knots);
  std::vector<SnapKnot> solved = knots;
  solve(equations, solved);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!knots[i].is_fixed && solved[i].along.allFinite()) {
      knots[i].along = solved[i].along;
    }
  }
}

PolynomialPiece piece_between(const SnapKnot& from, const SnapKnot& to, double duration_s) {
  const Vec3 scale = powers(duration_s);
  Eigen::Matrix<double, 8, 3> ends = Eigen::Matrix<double, 8, 3>::Zero();
  ends.row(4) = (to.p_W - from.p_W).transpose();  // Relative to the start: far from W's origin
  ends.middleRows<3>(1) = scale.cwiseProduct(from.along) * from.direction_W.transpose();
  ends.middleRows<3>(5) = scale.cwiseProduct(to.along) * to.direction_W.transpose();
  PolynomialPiece piece;
  piece.duration_s = duration_s;
  piece.c = (coefficients_from_ends() * ends).transpose();
  double power = 1.0;
  for (int k = 0; k < 8; ++k) {
    piece.c.col(k) /= power;
    power *= duration_s;
  }
  piece.c.col(0) = from.p_W;
  return piece;
}

bool control_reach_m(const SnapKnot& knot, double duration_s, bool forward, double& reach_m) {
  // The first control points of degree 7: p' = 7 dP / T, p'' = 42 d2P / T^2, p''' = 210 d3P / T^3.
  const double sign = forward ? 1.0 : -1.0;
  const Vec3 scaled = powers(duration_s).cwiseProduct(knot.along);
  const double first = scaled[0] / 7.0;
  const double second = 2.0 * first + sign * scaled[1] / 42.0;
  const double third = 3.0 * second - 3.0 * first + scaled[2] / 210.0;
  reach_m = third;
  return first >= 0.0 && second >= first && third >= second;
}

}  // namespace flyball
