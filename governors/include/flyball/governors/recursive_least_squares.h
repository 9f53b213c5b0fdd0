// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Least squares that takes one sample after another.

#include <Eigen/Core>

namespace flyball {

/// Estimates w in y = w.x + noise. With lambda = 1 and a prior w0 of covariance P0 (in units of the
/// noise's variance), after each sample w minimises
///
///     (w - w0)^T P0^-1 (w - w0) + sum_i lambda^(n-i) (y_i - w.x_i)^2
///
/// exactly; lambda < 1 forgets old samples (and the prior). Ljung, System Identification (1999),
/// eq. 11.12. Fixed size: allocates nothing.
template <int N>
class RecursiveLeastSquares {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  /// @pre `sigma > 0` in each component, `0 < forgetting <= 1`.
  RecursiveLeastSquares(const Vector& prior, const Vector& sigma, double forgetting)
      : w_{prior}, limit_{sigma.cwiseAbs2().sum()}, forgetting_{forgetting} {
    P_.diagonal() = sigma.cwiseAbs2();
  }

  void learn(const Vector& x, double y) {
    const Vector p_x = P_ * x;
    const Vector gain = p_x / (forgetting_ + x.dot(p_x));
    w_ += gain * (y - w_.dot(x));
    P_ -= gain * p_x.transpose();
    P_ = 0.5 * (P_ + P_.transpose().eval());  // rounding must not make it lopsided
    // Directions that no sample excites would grow without end ("wind-up"): forget only while the
    // whole stays below the prior.
    if (P_.trace() < forgetting_ * limit_) {
      P_ /= forgetting_;
    }
  }
  [[nodiscard]] double predict(const Vector& x) const { return w_.dot(x); }
  [[nodiscard]] const Vector& weights() const { return w_; }

 private:
  Vector w_;
  Eigen::Matrix<double, N, N> P_{Eigen::Matrix<double, N, N>::Zero()};
  double limit_;
  double forgetting_;
};

}  // namespace flyball
