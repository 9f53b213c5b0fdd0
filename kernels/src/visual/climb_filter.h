// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Height and climb rate from a barometer.

#include "flyball/runtime/time.h"

#include <optional>

namespace flyball {

/// Alpha-beta filter with the gains of the steady Kalman filter (Kalata 1984, IEEE TAES 20,
/// eqs. 9, 12, 13) for white acceleration: no lag in a steady climb, a decimetre of noise becomes
/// 3 cm.
class ClimbFilter {
 public:
  /// @param height_m  By the pressure; from any datum. Samples come in order of time, 100 a second.
  void update(double height_m, MissionTime now);
  [[nodiscard]] double height_m() const { return height_m_; }
  [[nodiscard]] double climb_m_s() const { return climb_m_s_; }

 private:
  double height_m_{};
  double climb_m_s_{};
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
