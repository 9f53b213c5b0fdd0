// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/trajectory.h"

#include "flyball/runtime/assert.h"

#include <algorithm>

namespace flyball {

Vec3 PolynomialPiece::derivative(int n, double t_s) const {
  FLYBALL_ASSERT(n >= 0, "n=%d", n);
  Vec3 value = Vec3::Zero();
  for (int k = static_cast<int>(c.cols()) - 1; k >= n; --k) {  // Horner
    double factor = 1.0;                                       // k! / (k - n)!
    for (int j = 0; j < n; ++j) {
      factor *= k - j;
    }
    value = value * t_s + factor * c.col(k);
  }
  return value;
}

double Trajectory::duration_s() const {
  double sum_s = 0.0;
  for (const PolynomialPiece& piece : pieces) {
    sum_s += piece.duration_s;
  }
  return sum_s;
}

Vec3 Trajectory::derivative(int n, double t_s) const {
  if (pieces.empty()) {
    return Vec3::Zero();
  }
  double left_s = std::max(t_s, 0.0);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    if (left_s < pieces[i].duration_s) {
      return pieces[i].derivative(n, left_s);
    }
    left_s -= pieces[i].duration_s;
  }
  return pieces.back().derivative(n, std::min(left_s, pieces.back().duration_s));
}

}  // namespace flyball
