// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/sender_clock.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

TEST(SenderClock, believes_the_message_that_waited_shortest) {
  SenderClock clock;
  EXPECT_EQ(clock.made(5000, 100ms), 100ms);
  EXPECT_LT(clock.made(5020, 117ms), 118ms);  // 3 ms sooner: the first one had waited as long.
  EXPECT_NEAR(to_seconds(clock.made(5040, 190ms)), 0.137, 1e-4);  // This one waited for 53 ms.
}

TEST(SenderClock, keeps_up_with_a_clock_that_is_slower) {
  SenderClock clock;
  Duration made{};
  Duration heard{};
  for (int i = 0; i < 10'000; ++i) {  // A simulation that runs at nine tenths of real time.
    heard = i * 20ms;
    made = clock.made(static_cast<std::uint32_t>(i * 18), heard);
    ASSERT_LE(made, heard);
    ASSERT_LT(to_seconds(heard - made), 0.11);  // A second's worth, of 20 s in all.
  }
}

TEST(SenderClock, knows_what_waited_while_nobody_listened) {
  SenderClock clock;
  for (std::uint32_t i = 0; i < 100; ++i) {
    (void)clock.made(20 * i, i * 20ms);
  }
  // Nobody listened for 3 s: what came first in them is old, whatever comes after it.
  EXPECT_EQ(clock.made(2000, 5s), 2s);
  EXPECT_EQ(clock.made(4990, 5s), 4990ms);
}

TEST(SenderClock, begins_anew_with_a_sender_that_does) {
  SenderClock clock;
  (void)clock.made(60'000, 10s);
  EXPECT_EQ(clock.made(100, 11s), 11s);
}

}  // namespace
}  // namespace flyball
