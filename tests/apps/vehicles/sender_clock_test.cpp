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
  for (int i = 0; i < 100'000; ++i) {  // Half an hour and a bit, 50 ppm slow.
    heard = i * 20ms + i * 1us;
    made = clock.made(static_cast<std::uint32_t>(i * 20), heard);
  }
  EXPECT_LE(made, heard);
  EXPECT_NEAR(to_seconds(made), to_seconds(heard), 0.001);  // 100 ms of drift in all.
}

TEST(SenderClock, begins_anew_with_a_sender_that_does) {
  SenderClock clock;
  (void)clock.made(60'000, 10s);
  EXPECT_EQ(clock.made(100, 11s), 11s);
}

}  // namespace
}  // namespace flyball
