// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Moving solids in a depth image.

#include "flyball/runtime/messages.h"
#include "flyball/sim/movers.h"

namespace flyball {

/// Where a mover is nearer than what the image shows, its depth replaces it.
/// @param image  Depth along the optical axis, without noise; its time says where the movers are.
void draw(const std::vector<Mover>& movers, const Pose& X_WC, DepthImage& image);

}  // namespace flyball
