// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Medians with intervals, for a few flights of each policy.

#include <optional>
#include <vector>

namespace flyball {

/// A median with its 95 % interval.
struct MedianInterval {
  double median{};
  double lo{};
  double hi{};
};

/// @pre `values` is not empty and finite.
[[nodiscard]] double median_of(std::vector<double> values);

/// Percentile bootstrap of the median with 2000 resamples from a fixed seed, so that the same
/// values give the same interval. With fewer than six values the interval is their whole range.
/// Empty for no values. Efron 1979, doi:10.1214/aos/1176344552.
[[nodiscard]] std::optional<MedianInterval> bootstrap_median(const std::vector<double>& values);

}  // namespace flyball
