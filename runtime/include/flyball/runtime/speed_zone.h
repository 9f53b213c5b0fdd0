// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a mission may only be flown slowly.

#include "flyball/runtime/geometry.h"

namespace flyball {

/// Inside the box the vehicle flies no faster than this (a scenario's rule, known on board).
struct SpeedZone {
  Aabb box_W{};
  double max_speed_m_s{};
};

}  // namespace flyball
