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
    if (last_ && to_seconds(captured - *last_) <= longest_gap_s) {
      seconds_ += to_seconds(captured - *last_);
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
