// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/quantile.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Quantile, interpolates_between_order_statistics) {
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(quantile({7.0}, 0.95), 7.0);
  EXPECT_DOUBLE_EQ(quantile({}, 0.5), 0.0);
}

}  // namespace
}  // namespace flyball
