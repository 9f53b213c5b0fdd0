// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What an autopilot reports of its vehicle.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/units.h"

#include <optional>

namespace flyball {

struct ReportedMotion {
  Pose X_WB{Pose::Identity()};
  Vec3 v_WB{Vec3::Zero()};
  Vec3 w_WB_B{Vec3::Zero()};  ///< Angular velocity in B [rad/s].
  Vec3 a_WB{Vec3::Zero()};    ///< From the reported velocities [m/s^2].
  bool rotors_turn{};         ///< It is armed.
  /// No older than .25 s. It goes on at its rates for so long, and stands still afterwards.
  bool is_fresh{};
};

/// As its power module measures it.
struct ReportedBattery {
  Watts power{};                    ///< Of all that hangs on it.
  std::optional<double> percent{};  ///< Of its charge that is left.
};

}  // namespace flyball
