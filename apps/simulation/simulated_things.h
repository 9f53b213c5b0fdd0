// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the simulator knows and the vehicle does not: the true world, the airframe, the cameras.

#include "flyball/runtime/messages.h"
#include "flyball/sim/airframe.h"
#include "flyball/sim/colour_camera.h"
#include "flyball/sim/world.h"

#include <memory>

namespace flyball {

/// The cameras of a simulated vehicle that see in colour.
struct ColourCameras {
  std::unique_ptr<ColourCamera> gimbal{};   ///< Null where nobody looks for people.
  std::unique_ptr<ColourCamera> forward{};  ///< Null with a localizer that needs no images.
};

/// What the simulated vehicle and its surroundings are made of.
struct SimulatedThings {
  World world{};
  GeodeticOrigin origin{};  ///< Of the world; the localizer is told it, too.
  Airframe airframe{};
  ColourCameras cameras{};
};

}  // namespace flyball
