// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Costs of single operations from measured times of many.

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include <Eigen/Dense>

namespace flyball {

/// CPU time: other programs on the host do not count.
template <class Run>
double seconds(Run&& run) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  run();
  return now() - start;
}

struct Sample {
  std::vector<double> counts;  ///< In the order of the fitted names.
  double host_s;
};

struct Fit {
  std::vector<double> seconds_per;
  double error;  ///< Root mean square, relative.
};

/// Least squares of relative errors over the best subset of non-negative coefficients.
inline Fit non_negative_fit(const std::vector<Sample>& samples) {
  const auto rows = static_cast<Eigen::Index>(samples.size());
  const auto columns = static_cast<Eigen::Index>(samples.front().counts.size());
  Eigen::VectorXd best;
  double best_error = 1e300;
  for (unsigned subset = 1; subset < 1U << columns; ++subset) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Sample& sample = samples[static_cast<std::size_t>(i)];
      for (Eigen::Index k = 0; k < columns; ++k) {
        if ((subset >> k & 1U) != 0) {
          a(i, k) = sample.counts[static_cast<std::size_t>(k)] / sample.host_s;
        }
      }
    }
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(rows);
    const Eigen::VectorXd c = a.completeOrthogonalDecomposition().solve(one);
    const double error = (a * c - one).squaredNorm();
    if (c.minCoeff() >= 0.0 && error < best_error) {
      best = c;
      best_error = error;
    }
  }
  return {{best.begin(), best.end()}, std::sqrt(best_error / static_cast<double>(rows))};
}

inline void print_fit(const std::string& kernel,
                      const std::vector<std::string>& names,
                      const std::vector<Sample>& samples,
                      double factor = 1.0) {
  const Fit fit = non_negative_fit(samples);
  std::printf("%s: root mean square error %.1f %% of %zu samples\n%s:", kernel.c_str(),
              100.0 * fit.error, samples.size(), kernel.c_str());
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::printf(" %s %.3g", names[k].c_str(), 1e9 * factor * fit.seconds_per[k]);
  }
  std::printf(" ns\n");
}

}  // namespace flyball
