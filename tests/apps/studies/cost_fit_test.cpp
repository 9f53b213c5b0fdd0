// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/cost_fit.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(CostFit, finds_costs_whose_counts_differ_by_a_million) {
  std::vector<CostSample> samples;
  for (int i = 1; i <= 20; ++i) {
    const double frames = i % 3;
    const double cells = 1e6 * (i * i % 7 + 1);
    samples.push_back({{frames, cells}, 2e-3 * frames + 3e-9 * cells});
  }
  const CostFit fit = non_negative_fit(samples);
  EXPECT_NEAR(fit.seconds_per[0], 2e-3, 1e-9);
  EXPECT_NEAR(fit.seconds_per[1], 3e-9, 1e-15);
  EXPECT_NEAR(fit.error, 0.0, 1e-6);
}

TEST(CostFit, gives_nothing_to_what_would_have_a_negative_cost) {
  // Without bounds, least squares give the second kind -1.
  const CostFit fit = non_negative_fit({{{1.0, 0.0}, 2.0}, {{1.0, 1.0}, 1.0}});
  EXPECT_EQ(fit.seconds_per[1], 0.0);
  // (x / 2 - 1)^2 + (x - 1)^2 is least at 6 / 5.
  EXPECT_NEAR(fit.seconds_per[0], 1.2, 1e-12);
  EXPECT_NEAR(fit.error, 0.31622776601683794, 1e-9);  // sqrt((.4^2 + .2^2) / 2)
}

TEST(CostFit, gives_nothing_to_what_never_happened) {
  const CostFit fit = non_negative_fit({{{2.0, 0.0}, 4.0}, {{3.0, 0.0}, 6.0}});
  EXPECT_NEAR(fit.seconds_per[0], 2.0, 1e-12);
  EXPECT_EQ(fit.seconds_per[1], 0.0);
}

}  // namespace
}  // namespace flyball
