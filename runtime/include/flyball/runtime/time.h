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

/// What a conversion yields for times that are longer, for infinity, and for what is not a number:
/// 126 years. The sum of two still fits.
inline constexpr Duration longest_duration{4'000'000'000'000'000'000};

/// A number of nanoseconds as a duration, within `longest_duration` on both sides of zero.
[[nodiscard]] inline Duration saturated(double ns) {
  constexpr auto most_ns = static_cast<double>(longest_duration.count());
  if (!(ns < most_ns)) {  // Not a number is no short time.
    return longest_duration;
  }
  return ns > -most_ns ? Duration{static_cast<std::int64_t>(ns)} : -longest_duration;
}

/// Rounded up to the next nanosecond, so that no job ends before its work is done; saturates at
/// `longest_duration`.
[[nodiscard]] inline Duration from_seconds(double s) {
  return saturated(std::ceil(s * 1e9));
}

/// Rounded to the nearest nanosecond, which undoes `to_seconds`; saturates at `longest_duration`.
[[nodiscard]] inline Duration nearest_duration(double s) {
  return saturated(std::round(s * 1e9));
}

}  // namespace flyball
