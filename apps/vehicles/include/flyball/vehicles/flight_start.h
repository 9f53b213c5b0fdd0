// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a vehicle stands when it is connected, and how it will be flown.

#include "flyball/runtime/geometry.h"

namespace flyball {

struct FlightStart {
  Vec3 p_WB{Vec3::Zero()};         ///< What the autopilot's local position at that moment is in W.
  double ground_z_m{};             ///< Heights of take-off count from here.
  double max_acceleration_m_s2{};  ///< What set-points brake with at most; 0: not known.
};

}  // namespace flyball
