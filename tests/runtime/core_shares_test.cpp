// SPDX-License-Identifier: BSD-3-Clause
#include "core_shares.h"

#include <numeric>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Shares = std::vector<double>;

TEST(CoreShares, urgent_claims_are_served_first) {
  EXPECT_EQ(share_cores({{0, 1.0}, {5, 2.0}, {0, 1.0}}, 3.0), (Shares{0.5, 2.0, 0.5}));
}

TEST(CoreShares, what_one_cannot_use_goes_to_its_equals) {
  EXPECT_EQ(share_cores({{0, 4.0}, {0, 1.0}, {0, 4.0}}, 4.0), (Shares{1.5, 1.0, 1.5}));
}

TEST(CoreShares, what_a_class_leaves_goes_to_the_next) {
  EXPECT_EQ(share_cores({{1, 1.0}, {1, 1.0}, {0, 4.0}}, 4.0), (Shares{1.0, 1.0, 2.0}));
}

TEST(CoreShares, rounding_leaves_no_crumbs_for_a_lower_class) {
  for (std::size_t n = 1; n < 50; ++n) {
    std::vector<CoreClaim> claims(n, CoreClaim{1, 1.0});
    claims.push_back({0, 1.0});
    const Shares shares = share_cores(claims, 1.0);
    EXPECT_EQ(shares.back(), 0.0) << n;
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1.0, 1e-12);
  }
}

TEST(CoreShares, no_cores_and_no_claims_are_fine) {
  EXPECT_EQ(share_cores({{0, 1.0}}, 0.0), Shares{0.0});
  EXPECT_TRUE(share_cores({}, 4.0).empty());
}

}  // namespace
}  // namespace flyball
