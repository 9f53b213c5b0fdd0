// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much of a flight goes by in waiting for the computer.

#include "flyball/runtime/observation.h"

#include <optional>

namespace flyball {

/// The share w of the last minute of cruise in which the vehicle stood: it waits for a map, a plan
/// or the next view then. A speed limit knows nothing of such waits, and of what was computed in
/// flight some may come too late for them. If all of w grew as the computer slows down, a clock f
/// would make the mission longer by
///
///     1 + w (f_top / f - 1),
///
/// and so much more energy per metre is what a lower clock must save before it is worth it.
class WaitingShare {
 public:
  /// Once per decision.
  void note(const Observation& seen);
  /// w, 0 to 1.
  [[nodiscard]] double share() const { return share_; }
  /// The factor above, in the worst case. @pre 0 < `clock_hz` <= `top_hz`.
  [[nodiscard]] double delay(double clock_hz, double top_hz) const;

 private:
  double share_{};
  std::optional<MissionTime> last_{};  ///< Empty outside of cruise.
};

}  // namespace flyball
