// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/cost_fit.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace flyball {
namespace {

/// Minimises |A c - 1|, of which only A'A, A'1 and the number of rows matter.
struct Normal {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
  double rows{};

  [[nodiscard]] double error(const Eigen::VectorXd& c) const {
    return c.dot(gram * c) - 2.0 * c.dot(right) + rows;
  }
};

Normal normal_of(const std::vector<CostSample>& samples) {
  const auto columns = static_cast<Eigen::Index>(samples.front().counts.size());
  Normal normal{Eigen::MatrixXd::Zero(columns, columns), Eigen::VectorXd::Zero(columns),
                static_cast<double>(samples.size())};
  for (const CostSample& sample : samples) {
    FLYBALL_ASSERT(sample.time_s > 0.0, "a call took no time");
    const Eigen::VectorXd row =
        Eigen::Map<const Eigen::VectorXd>{sample.counts.data(), columns} / sample.time_s;
    normal.gram += row * row.transpose();
    normal.right += row;
  }
  return normal;
}

/// With all coefficients outside `subset` at zero.
Eigen::VectorXd solved(const Normal& normal, unsigned subset) {
  const Eigen::Index columns = normal.right.size();
  Eigen::VectorXd kept = Eigen::VectorXd::Zero(columns);
  // Counts of some kinds are a million times those of others; with ones on the diagonal the rank is
  // found all the same.
  for (Eigen::Index k = 0; k < columns; ++k) {
    const double size = normal.gram(k, k);
    kept(k) = (subset >> k & 1U) != 0 && size > 0.0 ? 1.0 / std::sqrt(size) : 0.0;
  }
  const Eigen::MatrixXd gram = kept.asDiagonal() * normal.gram * kept.asDiagonal();
  const Eigen::VectorXd right = kept.asDiagonal() * normal.right;
  return kept.asDiagonal() * gram.completeOrthogonalDecomposition().solve(right);
}

}  // namespace

CostFit non_negative_fit(const std::vector<CostSample>& samples) {
  FLYBALL_ASSERT(!samples.empty() && samples.front().counts.size() <= 12,
                 "nothing to fit, or too many kinds of operations");
  const Normal normal = normal_of(samples);
  Eigen::VectorXd best = Eigen::VectorXd::Zero(normal.right.size());
  double best_error = normal.rows;
  for (unsigned subset = 1; subset < 1U << static_cast<unsigned>(normal.right.size()); ++subset) {
    const Eigen::VectorXd c = solved(normal, subset);
    const double error = normal.error(c);
    if (c.minCoeff() >= 0.0 && error < best_error) {
      best = c;
      best_error = error;
    }
  }
  return {{best.begin(), best.end()}, std::sqrt(std::max(0.0, best_error) / normal.rows)};
}

}  // namespace flyball
