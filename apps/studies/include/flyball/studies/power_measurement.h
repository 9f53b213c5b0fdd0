// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the computer takes at each clock with so many cores busy.

#include "flyball/studies/calibration.h"

#include <chrono>
#include <functional>
#include <vector>

namespace flyball {

struct PowerMeasurement {
  std::vector<Hertz> clocks{};         ///< Set in turn.
  std::function<Status(Hertz)> set{};  ///< Empty: the clock stays as it is.
  std::vector<int> cpus{};             ///< Kept busy, in this order.
  std::function<Watts()> meter{};
  std::chrono::nanoseconds settling{std::chrono::milliseconds{500}};  ///< Chosen: meters average.
  std::chrono::nanoseconds period{std::chrono::milliseconds{100}};    ///< Between two readings.
  int readings{10};                                                   ///< Of which the mean counts.
};

/// Takes (cpus + 1) x clocks x (settling + readings x period). Nothing else should run meanwhile.
/// @error Those of `PowerMeasurement::set`; `unavailable`: no thread may run on a core.
[[nodiscard]] Result<std::vector<MeasuredPower>> measure_power(const PowerMeasurement& how);

}  // namespace flyball
