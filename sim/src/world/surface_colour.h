// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Colours of the world's surfaces: patterns that are computed, so that no picture need be shipped.

#include "flyball/sim/world.h"

#include <Eigen/Core>

namespace flyball {

struct SurfacePoint {
  Eigen::Vector3f p_W{Eigen::Vector3f::Zero()};
  Eigen::Vector3f normal_W{Eigen::Vector3f::UnitZ()};  ///< Length 1.
  float footprint_m{};  ///< What one pixel covers there: finer detail is averaged out.
};

/// Red, green, blue under white light, 0..1.
[[nodiscard]] Eigen::Vector3f surface_colour(Material material, const SurfacePoint& point);
/// Of the sky in a direction of length 1; `to_sun_W` too.
[[nodiscard]] Eigen::Vector3f sky_colour(const Eigen::Vector3f& direction_W,
                                         const Eigen::Vector3f& to_sun_W);

}  // namespace flyball
