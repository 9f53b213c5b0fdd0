// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When a message was made, by our clock.

#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>

namespace flyball {

/// Messages wait in lines, and for a program that draws pictures meanwhile. The one that waited
/// shortest tells how the sender's clock stands, but for the time that it travelled.
class SenderClock {
 public:
  /// @param boot_ms  The sender's time in the message.
  /// @param heard    When it arrived; never falls.
  /// @return         When it was made, at the latest; not after `heard`.
  Duration made(std::uint32_t boot_ms, Duration heard);

 private:
  std::optional<Duration> ahead_{};  ///< Ours minus the sender's.
  Duration last_made_{};             ///< By the sender's clock.
  Duration last_heard_{};
};

}  // namespace flyball
