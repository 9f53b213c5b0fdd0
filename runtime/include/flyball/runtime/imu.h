// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What an inertial measurement unit says.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"

namespace flyball {

struct ImuSample {
  MissionTime stamp{};
  Vec3 w_WB_B{Vec3::Zero()};  ///< Angular velocity [rad/s].
  Vec3 f_B{Vec3::Zero()};  ///< Specific force [m/s^2]: acceleration less gravity; +9.8 z at rest.
};

}  // namespace flyball
