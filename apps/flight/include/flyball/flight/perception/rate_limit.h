// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Frames at a lower rate than they arrive at.

#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/time.h"

#include <optional>

namespace flyball {

/// Lets frames pass at a rate that may change between any two of them.
class RateLimit {
 public:
  /// Whether the frame that was captured at this time is due. One from before the last one is: the
  /// camera's clock has begun anew.
  /// @pre `rate_hz > 0`.
  [[nodiscard]] bool passes(MissionTime captured, double rate_hz) {
    const bool goes_on = last_ && captured >= *last_;
    if (goes_on && to_seconds(captured - *last_) < least_share_of_interval / rate_hz) {
      return false;
    }
    last_ = captured;
    return true;
  }

 private:
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
