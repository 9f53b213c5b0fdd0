// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/clock_meter.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

// Whatever this runs on, and however busy it is. (qemu adds at a tenth of the host's clock.)
constexpr Hertz slowest{20e6};
constexpr Hertz fastest{8e9};

TEST(ClockMeter, finds_a_clock_that_a_processor_may_have) {
  const Hertz clock = clock_by_additions(1.0);
  EXPECT_GT(clock, slowest);
  EXPECT_LT(clock, fastest);
  // The same chain, thought to take twice as many cycles, within what a busy machine may change.
  const Hertz doubled = clock_by_additions(2.0);
  EXPECT_GT(doubled.value(), 1.2 * clock.value());
}

TEST(ClockMeter, says_how_it_measures) {
  ClockMeter meter;
  const bool counts = meter.source() == "cycles over task-clock";
  EXPECT_TRUE(counts || meter.source().rfind("additions (no counter of cycles: ", 0) == 0)
      << meter.source();
  (void)meter.measure();
  for (int i = 0; i < 100; ++i) {
    (void)clock_by_additions(1.0);  // So that there is a busy time to count in.
  }
  const auto clock = meter.measure();
  ASSERT_TRUE(clock);
  EXPECT_GT(*clock, slowest);
  EXPECT_LT(*clock, fastest);
}

}  // namespace
}  // namespace flyball
