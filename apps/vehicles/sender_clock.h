// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When a message was made, by our clock.

#include "flyball/runtime/time.h"

#include <cstdint>
#include <optional>

namespace flyball {

/// Messages wait in lines, and for a program that draws pictures meanwhile. The one that waited
/// shortest lately tells how the sender's clock stands, but for the time that it travelled.
/// "Lately" is the last half to whole second: an autopilot in simulation runs as fast as its
/// computer lets it (PX4's own ran 8 ms slow in each second beside a busy core), and a longer
/// memory would take what it lost for age.
class SenderClock {
 public:
  /// @param boot_ms  The sender's time in the message.
  /// @param heard    When it arrived; never falls.
  /// @return         When it was made, at the latest; not after `heard`.
  Duration made(std::uint32_t boot_ms, Duration heard);

 private:
  void listen(Duration heard);

  std::optional<Duration> ahead_{};   ///< Ours minus the sender's, least of this part.
  std::optional<Duration> before_{};  ///< The same of the part before.
  Duration part_{};                   ///< So long this part has been listened to.
  Duration last_made_{};              ///< By the sender's clock.
  Duration last_heard_{};
};

}  // namespace flyball
