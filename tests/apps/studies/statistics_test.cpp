// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/statistics.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// P(X >= k) for X ~ Binomial(n, p).
double at_least(int k, int n, double p) {
  double sum = 0.0;
  for (int i = k; i <= n; ++i) {
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                    i * std::log(p) + (n - i) * std::log1p(-p));
  }
  return sum;
}

/// Rank of the exact bootstrap quantile of the median of n distinct values, n odd: the median of a
/// resample is at most the k-th value when at least (n + 1) / 2 of its members are.
int exact_rank(double probability, int n) {
  for (int k = 1; k < n; ++k) {
    if (at_least((n + 1) / 2, n, static_cast<double>(k) / n) >= probability) {
      return k;
    }
  }
  return n;
}

std::vector<double> ranks(int n) {
  std::vector<double> values;
  for (int i = 1; i <= n; ++i) {
    values.push_back(i);
  }
  return values;
}

TEST(Statistics, the_median_of_an_even_count_lies_between_the_middle_two) {
  EXPECT_EQ(median_of({3.0}), 3.0);
  EXPECT_EQ(median_of({9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median_of({9.0, 1.0, 2.0, 3.0}), 2.5);
}

TEST(Statistics, no_values_have_no_interval) {
  EXPECT_FALSE(bootstrap_median({}).has_value());
}

TEST(Statistics, the_interval_of_few_values_is_their_range) {
  for (int n = 1; n <= 5; ++n) {
    const auto interval = bootstrap_median(ranks(n));
    EXPECT_EQ(interval->lo, 1.0) << n;
    EXPECT_EQ(interval->hi, n) << n;
  }
}

TEST(Statistics, the_bootstrap_agrees_with_its_closed_form) {
  // 2000 resamples estimate a 2.5 % tail to +-.35 % (one standard deviation): one rank to either
  // side.
  for (const int n : {9, 15, 31, 75}) {
    const auto interval = bootstrap_median(ranks(n));
    EXPECT_NEAR(interval->lo, exact_rank(0.025, n), 1.0) << n;
    EXPECT_NEAR(interval->hi, exact_rank(0.975, n), 1.0) << n;
    EXPECT_EQ(interval->median, (n + 1) / 2) << n;
  }
}

TEST(Statistics, the_order_of_the_values_does_not_matter) {
  std::vector<double> values = ranks(20);
  const auto sorted = bootstrap_median(values);
  std::reverse(values.begin(), values.end());
  const auto reversed = bootstrap_median(values);
  EXPECT_EQ(sorted->lo, reversed->lo);
  EXPECT_EQ(sorted->hi, reversed->hi);
}

}  // namespace
}  // namespace flyball
