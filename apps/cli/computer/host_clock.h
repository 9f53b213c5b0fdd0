// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The monotonic clock of this computer.

#include "flyball/runtime/time.h"

#include <chrono>

namespace flyball {

/// The time since any moment.
[[nodiscard]] inline Duration host_clock() {
  return Duration{std::chrono::steady_clock::now().time_since_epoch()};
}

}  // namespace flyball
