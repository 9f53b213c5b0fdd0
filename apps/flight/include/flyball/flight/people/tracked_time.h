// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// For how long somebody was tracked.

#include "flyball/runtime/time.h"

#include <optional>

namespace flyball {

/// Time from frame to frame; gaps of up to 1 s count when the person was tracked on both sides.
class TrackedTime {
 public:
  void on_target(MissionTime captured) {
    // A camera whose clock begins anew takes no time back.
    const double since_s = last_ ? to_seconds(captured - *last_) : 0.0;
    if (since_s > 0.0 && since_s <= longest_gap_s) {
      seconds_ += since_s;
    }
    last_ = captured;
  }
  [[nodiscard]] double seconds() const { return seconds_; }

 private:
  static constexpr double longest_gap_s = 1.0;
  std::optional<MissionTime> last_{};
  double seconds_{};
};

}  // namespace flyball
