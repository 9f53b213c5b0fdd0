// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a vehicle stands when it is connected.

#include "flyball/runtime/geometry.h"

namespace flyball {

struct FlightStart {
  Vec3 p_WB{Vec3::Zero()};  ///< What the autopilot's local position at that moment is in W.
  double ground_z_m{};      ///< Heights of take-off count from here.
};

}  // namespace flyball
