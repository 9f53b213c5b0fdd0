// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Frames at a lower rate than they arrive at.

#include "flyball/runtime/time.h"

#include <cmath>
#include <optional>

namespace flyball {

/// A frame passes this share of the wanted interval after the last one, so that a 20 Hz camera
/// satisfies a 20 Hz knob although its stamps are rounded.
inline constexpr double least_share_of_interval = 0.9;

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

/// The interval between frames behind a limit, of frames that arrive at an even interval before it.
/// @pre Both are positive.
[[nodiscard]] inline double passed_interval_s(double interval_s, double rate_hz) {
  constexpr double rounding = 1e-9;  // 4 x .05 s are a little more than .2 s.
  const double frames = least_share_of_interval / (rate_hz * interval_s);
  return std::fmax(1.0, std::ceil(frames - rounding)) * interval_s;
}

}  // namespace flyball
