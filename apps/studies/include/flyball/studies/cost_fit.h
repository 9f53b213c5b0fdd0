// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Costs of single operations from measured times of many.

#include <vector>

namespace flyball {

/// One measured call.
struct CostSample {
  std::vector<double> counts{};  ///< Of each kind of operation, always in the same order.
  double time_s{};               ///< Above 0.
};

struct CostFit {
  std::vector<double> seconds_per{};  ///< Of each kind, not negative.
  double error{};                     ///< Root mean square of the relative errors.
};

/// Least squares of relative errors over the best subset of non-negative coefficients.
/// Exact, by trying all subsets: for up to 12 kinds.
/// @pre  There is a sample, and all have equally many counts.
[[nodiscard]] CostFit non_negative_fit(const std::vector<CostSample>& samples);

}  // namespace flyball
