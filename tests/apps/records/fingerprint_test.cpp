// SPDX-License-Identifier: BSD-3-Clause
#include "records/fingerprint.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(NumericFingerprint, is_the_same_twice_on_one_host) {
  EXPECT_EQ(numeric_fingerprint(), numeric_fingerprint());
  EXPECT_EQ(numeric_fingerprint().size(), 16U);
}

}  // namespace
}  // namespace flyball
