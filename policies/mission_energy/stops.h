// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How often the vehicle stops on its way.

#include "flyball/runtime/observation.h"

#include <optional>

namespace flyball {

/// An exploration stops at each view, until a frame that was taken at rest is in the map; a delivery
/// hardly ever does. So this says what the latency of a map costs beside speed. It begins with half
/// a stop in 50 m (chosen: the first stops of an exploration outweigh it).
class Stops {
 public:
  void note(const Observation& seen) {
    constexpr double standing_m_s = 0.1;  // Chosen: slower than any cruise.
    constexpr double flying_m_s = 0.5;    // Chosen: faster than a vehicle that holds its place.
    constexpr double longest_m = 100.0;   // Between two observations; more must be a fault.
    const double flown_m = last_ ? seen.speed_m_s * to_seconds(seen.now - *last_) : 0.0;
    last_ = seen.now;
    flown_m_ += flown_m > 0.0 && flown_m < longest_m ? flown_m : 0.0;
    if (seen.phase != MissionPhase::cruise) {
      is_flying_ = false;
    } else if (is_flying_ && seen.speed_m_s < standing_m_s) {
      is_flying_ = false;
      stops_ += 1.0;
    } else {
      is_flying_ = is_flying_ || seen.speed_m_s > flying_m_s;
    }
  }
  [[nodiscard]] double per_m() const { return stops_ / flown_m_; }

 private:
  double stops_{0.5};
  double flown_m_{50.0};
  bool is_flying_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
