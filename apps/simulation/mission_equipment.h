// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a scenario puts on board.

#include "flyball/flight/mission_kernels.h"
#include "flyball/runtime/geometry.h"
#include "flyball/runtime/knob.h"

namespace flyball {

struct MissionEquipment {
  Cylinder body{};  ///< Of the airframe.
  KnobSettings knobs{};
  MissionKernels kernels{};
  bool has_rgb_camera{};  ///< Through the lens of the depth camera, for a localizer that needs it.
};

}  // namespace flyball
