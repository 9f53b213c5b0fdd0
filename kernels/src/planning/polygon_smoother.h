// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A polygon that is known to be free as a smooth curve with straight edges and round corners.

#include "flyball/kernels/smoother.h"

namespace flyball {

/// The implementation of `Smoother::smooth`.
/// @param derivative  Whose square the curve keeps small: 3 for jerk, 4 for snap.
[[nodiscard]] Result<SmoothPath> smooth_polygon(const SmoothRequest& request,
                                                const OccupancyView& map,
                                                int derivative);

}  // namespace flyball
