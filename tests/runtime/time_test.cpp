// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/time.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Time, rounds_seconds_up_to_the_next_nanosecond) {
  EXPECT_EQ(from_seconds(0.25), Duration{250'000'000});
  EXPECT_EQ(from_seconds(1.1e-9), Duration{2});
  EXPECT_EQ(from_seconds(-1.1e-9), Duration{-1});
  EXPECT_EQ(nearest_duration(1.1e-9), Duration{1});
  EXPECT_EQ(nearest_duration(-1.1e-9), Duration{-1});
}

TEST(Time, brings_seconds_back_to_the_same_nanosecond) {
  for (std::int64_t ns = 1; ns < 1'000'000'000'000'000; ns = ns * 3 + 7) {
    EXPECT_EQ(nearest_duration(to_seconds(Duration{ns})).count(), ns);
  }
}

TEST(Time, saturates_what_does_not_fit) {
  for (const double s : {4.1e9, 5.6e9, 9.3e9, 1e300, infinity, std::nan("")}) {
    EXPECT_EQ(from_seconds(s), longest_duration) << s;
    EXPECT_EQ(nearest_duration(s), longest_duration) << s;
  }
  for (const double s : {-4.1e9, -9.3e9, -1e300, -infinity}) {
    EXPECT_EQ(from_seconds(s), -longest_duration) << s;
    EXPECT_EQ(nearest_duration(s), -longest_duration) << s;
  }
}

TEST(Time, the_longest_duration_may_be_added_to_itself) {
  EXPECT_GT(longest_duration + longest_duration, longest_duration);
  EXPECT_LT(-longest_duration - longest_duration, -longest_duration);
}

}  // namespace
}  // namespace flyball
