// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/rate_limit.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double frame_s = 0.05;

/// When the frames of a 20 Hz camera passed within two seconds.
std::vector<double> passed_s(double rate_hz) {
  RateLimit limit;
  std::vector<double> times_s;
  for (int i = 0; i < 40; ++i) {
    if (limit.passes(MissionTime{50ms * i}, rate_hz)) {
      times_s.push_back(frame_s * i);
    }
  }
  return times_s;
}

TEST(RateLimit, passes_as_many_frames_as_it_is_told) {
  for (const auto& [rate_hz, frames] : {std::pair{240.0, 40}, {20.0, 40}, {10.0, 20}, {5.0, 10}}) {
    EXPECT_EQ(static_cast<int>(passed_s(rate_hz).size()), frames) << rate_hz;
  }
}

TEST(RateLimit, passes_on_when_the_cameras_clock_begins_anew) {
  RateLimit limit;
  EXPECT_TRUE(limit.passes(MissionTime{101s}, 10.0));
  EXPECT_TRUE(limit.passes(MissionTime{5s}, 10.0));
  EXPECT_FALSE(limit.passes(MissionTime{5050ms}, 10.0));
  EXPECT_TRUE(limit.passes(MissionTime{5100ms}, 10.0));
}

TEST(RateLimit, may_change_between_two_frames) {
  RateLimit limit;
  EXPECT_TRUE(limit.passes(MissionTime{0ms}, 1.0));
  EXPECT_FALSE(limit.passes(MissionTime{100ms}, 1.0));
  EXPECT_TRUE(limit.passes(MissionTime{150ms}, 10.0));
}

TEST(PassedInterval, is_the_one_at_which_frames_pass) {
  for (const double rate_hz : {240.0, 20.0, 18.0, 12.0, 10.0, 7.0, 20.0 / 3, 5.0, 4.0, 2.5, 1.0}) {
    const auto times_s = passed_s(rate_hz);
    ASSERT_GE(times_s.size(), 2U);
    EXPECT_NEAR(passed_interval_s(frame_s, rate_hz), times_s[1] - times_s[0], 1e-9) << rate_hz;
  }
}

}  // namespace
}  // namespace flyball
