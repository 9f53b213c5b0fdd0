// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much of a flight the vehicle spends waiting for the computer.

#include "flyball/runtime/observation.h"

#include <optional>

namespace flyball {

/// Whether the vehicle stands although it is to cruise, because it waits for a map, a plan or the
/// next view. A speed that is no number counts as standing.
[[nodiscard]] bool stands_in_cruise(const Observation& seen);

/// The share w of the last minute of cruise in which the vehicle stood, because it waited for a
/// map, a plan or the next view. A speed limit does not tell of such waits. If all of them grew as
/// the computer slows down, a clock f would make the mission longer by the factor
///
///     1 + w (f_top / f - 1),
///
/// so a lower clock must save at least that much energy per metre.
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
