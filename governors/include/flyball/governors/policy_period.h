// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often a policy from a file may want to be asked.

#include <array>
#include <cstdio>

namespace flyball {

/// What is wrong with it, as the end of a sentence with a zero behind it; empty: nothing. Each
/// decision stays in the record, and no knob takes effect within a millisecond.
[[nodiscard]] inline std::array<char, 96> fault_of_period(double period_s) {
  constexpr double least_s = 1e-3;
  constexpr double most_s = 3600.0;
  if (period_s >= least_s && period_s <= most_s) {
    return {};
  }
  std::array<char, 96> text{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  std::snprintf(text.data(), text.size(),
                "period_s is %g; it must be a number of seconds, %g to %g", period_s, least_s,
                most_s);
  return text;
}

}  // namespace flyball
