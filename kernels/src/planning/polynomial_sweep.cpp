// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/polynomial_sweep.h"

#include <algorithm>
#include <array>
#include <utility>

namespace flyball {
namespace {

constexpr int degree = 7;
constexpr double least_tolerance_m = 1e-6;
constexpr double rounding_m = 1e-9;  // of control points, some kilometres from the origin
constexpr int most_halvings = 40;    // of what is not finite; else far fewer are needed

using ControlPoints = std::array<Vec3, degree + 1>;

constexpr std::array<std::array<double, degree + 1>, degree + 1> binomials() {
  std::array<std::array<double, degree + 1>, degree + 1> choose{};
  for (std::size_t n = 0; n <= degree; ++n) {
    choose[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) {
      choose[n][k] = choose[n - 1][k - 1] + (k < n ? choose[n - 1][k] : 0.0);
    }
  }
  return choose;
}

/// b_i = sum_k C(i, k) / C(7, k) c_k T^k: the same curve for u = t / T in [0, 1].
ControlPoints control_points(const PolynomialPiece& piece) {
  static constexpr auto choose = binomials();
  ControlPoints points;
  for (std::size_t i = 0; i <= degree; ++i) {
    points[i] = Vec3::Zero();
    double power = 1.0;
    for (std::size_t k = 0; k <= i; ++k) {
      points[i] += choose[i][k] / choose[degree][k] * power * piece.c.col(static_cast<int>(k));
      power *= piece.duration_s;
    }
  }
  return points;
}

/// By de Casteljau.
std::pair<ControlPoints, ControlPoints> halves(ControlPoints points) {
  std::pair<ControlPoints, ControlPoints> result;
  for (std::size_t round = 0; round <= degree; ++round) {
    result.first[round] = points[0];
    result.second[degree - round] = points[degree - round];
    for (std::size_t i = 0; i + round < degree; ++i) {
      points[i] = 0.5 * (points[i] + points[i + 1]);
    }
  }
  return result;
}

/// How far the curve may be from the place on its chord that belongs to the same u.
struct Deviation {
  double across_m{};
  double up_m{};
};

Deviation deviation(const ControlPoints& points) {
  Deviation most;
  const Vec3 chord = points.back() - points.front();
  for (std::size_t i = 1; i < degree; ++i) {
    const Vec3 off = points[i] - points.front() - static_cast<double>(i) / degree * chord;
    most.across_m = std::max(most.across_m, off.head<2>().norm());
    most.up_m = std::max(most.up_m, std::abs(off.z()));
  }
  return most;
}

class Sweep {
 public:
  Sweep(const OccupancyView& map, const Cylinder& body, double tolerance_m)
      : map_{map}, body_{body}, tolerance_m_{std::max(tolerance_m, least_tolerance_m)} {}

  [[nodiscard]] bool hits(const ControlPoints& points, int halvings) const {
    const Deviation off = deviation(points);
    const Cylinder cover{body_.radius_m + off.across_m + rounding_m,
                         body_.half_height_m + off.up_m + rounding_m};
    if (!map_.segment_hits(points.front(), points.back(), cover)) {
      return false;
    }
    if (halvings == 0 || (off.across_m <= tolerance_m_ && off.up_m <= tolerance_m_)) {
      return true;
    }
    const auto [first, second] = halves(points);
    return hits(first, halvings - 1) || hits(second, halvings - 1);
  }

 private:
  const OccupancyView& map_;
  Cylinder body_;
  double tolerance_m_;
};

}  // namespace

bool sweep_hits(const OccupancyView& map,
                const PolynomialPiece& piece,
                const Cylinder& body,
                double tolerance_m) {
  const ControlPoints points = control_points(piece);
  const bool is_finite =
      std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
  return !is_finite || Sweep{map, body, tolerance_m}.hits(points, most_halvings);
}

}  // namespace flyball
