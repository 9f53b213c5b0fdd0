// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The mission's time of a moment that a clock of the host names.

#include "flyball/runtime/time.h"

#include <algorithm>

namespace flyball {

/// Both clocks run equally fast. A mission that is late to say where it is looks as if it had begun
/// later, so the earliest beginning counts.
class ClockOffset {
 public:
  /// The mission is at `now`, and the host's clock at `host`.
  void note(MissionTime now, Duration host) {
    const Duration began = host - now.time_since_epoch();
    began_ = is_known_ ? std::min(began_, began) : began;
    is_known_ = true;
  }
  [[nodiscard]] MissionTime mission(Duration host) const { return MissionTime{host - began_}; }
  [[nodiscard]] Duration host(MissionTime at) const { return began_ + at.time_since_epoch(); }

 private:
  Duration began_{};  ///< The host's time at the mission's zero.
  bool is_known_{};
};

}  // namespace flyball
