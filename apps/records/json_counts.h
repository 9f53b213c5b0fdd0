// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Counts and times of a record that somebody may have damaged or made up. The JSON library's own
/// getters turn -1 into 2^64 - 1 and 1e300 into anything.

#include "flyball/runtime/time.h"

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace flyball {

/// @throw std::out_of_range, in words, unless the member is a whole number in the type's range.
template <class Count = std::uint64_t, class Json>
[[nodiscard]] Count count_in(const Json& object, const char* key) {
  const Json& value = object.at(key);
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<Count>::max());
  if (!value.is_number_unsigned() || value.template get<std::uint64_t>() > most) {
    throw std::out_of_range{std::string{key} + " = " + value.dump() + " is no count"};
  }
  return static_cast<Count>(value.template get<std::uint64_t>());
}

/// To the nanosecond, so that it undoes `to_seconds`, which `from_seconds` would not: that rounds
/// up.
/// @throw std::out_of_range, in words, unless it is a time that a mission can have.
template <class Json>
[[nodiscard]] Duration seconds_in(const Json& object, const char* key) {
  const Json& value = object.at(key);
  constexpr double longest_s = 1e6;  // Missions end after a day at the latest.
  const bool is_time = value.is_number() && value.template get<double>() >= 0.0 &&
                       value.template get<double>() <= longest_s;
  if (!is_time) {
    throw std::out_of_range{std::string{key} + " = " + value.dump() + " is no time of a mission"};
  }
  return nearest_duration(value.template get<double>());
}

}  // namespace flyball
