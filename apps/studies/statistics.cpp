// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/statistics.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <cstddef>

namespace flyball {
namespace {

constexpr std::size_t resamples = 2000;
// Ranks of the 2.5 % and 97.5 % quantiles among the sorted resamples, counted from 0.
constexpr std::size_t low_rank = resamples / 40;
constexpr std::size_t high_rank = resamples - 1 - low_rank;

}  // namespace

double median_of(std::vector<double> values) {
  FLYBALL_ASSERT(!values.empty(), "no values");
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::optional<MedianInterval> bootstrap_median(const std::vector<double>& values) {
  if (values.empty()) {
    return std::nullopt;
  }
  std::vector<double> sorted = values;  // The order in which flights ended must not matter.
  std::sort(sorted.begin(), sorted.end());
  RandomStream draws{1, "bootstrap"};
  std::vector<double> medians(resamples);
  std::vector<double> sample(values.size());
  for (double& median : medians) {
    for (double& value : sample) {
      value =
          sorted[draws.next() % sorted.size()];  // The bias of % is below 1e-16 for any count here.
    }
    median = median_of(sample);
  }
  std::sort(medians.begin(), medians.end());
  return MedianInterval{median_of(values), medians[low_rank], medians[high_rank]};
}

}  // namespace flyball
