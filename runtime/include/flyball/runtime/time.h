// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Mission time (advanced by the simulator or a flight clock) and host time do not mix.

#include <chrono>
#include <cmath>
#include <cstdint>

namespace flyball {

using Duration = std::chrono::nanoseconds;

struct MissionClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<MissionClock>;
};

using MissionTime = MissionClock::time_point;
using HostTime = std::chrono::steady_clock::time_point;

/// `a / b` as a real number. (`a / b` itself divides integers and truncates.)
/// @pre `b` is not zero.
[[nodiscard]] constexpr double ratio(Duration a, Duration b) {
  return static_cast<double>(a.count()) / static_cast<double>(b.count());
}

[[nodiscard]] constexpr double to_seconds(Duration d) {
  return static_cast<double>(d.count()) * 1e-9;
}
[[nodiscard]] constexpr double to_seconds(MissionTime t) {
  return to_seconds(t.time_since_epoch());
}

/// Rounded up to the next nanosecond, so that no job ends before its work is done.
[[nodiscard]] inline Duration from_seconds(double s) {
  return Duration{static_cast<std::int64_t>(std::ceil(s * 1e9))};
}

}  // namespace flyball
