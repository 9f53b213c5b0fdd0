// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The point that a pixel of a depth image stands for.

#include <cmath>
#include <optional>

#include <Eigen/Core>

namespace flyball {

/// A ray without return is longer than the reach by this factor, so that a mapper with the same
/// range cuts it there.
inline constexpr double beyond_reach = 1.001;

struct PixelPoint {
  Eigen::Vector3f p_C;  ///< In the camera's frame [m].
  bool is_hit;
};

/// @param x, y     Where the middle of the pixel looks: coordinates of its ray of depth 1.
/// @param depth_m  Along the optical axis. Not a number, or not in front of the camera: a broken
///                 measurement, which is no point.
/// @param reach_m  Longer rays have no return.
[[nodiscard]] inline std::optional<PixelPoint> point_of_pixel(double x,
                                                              double y,
                                                              double depth_m,
                                                              double reach_m) {
  const double length = std::sqrt(x * x + (y * y + 1.0));
  const Eigen::Vector3d ray_C{x, y, 1.0};
  if (depth_m * length > reach_m) {
    return PixelPoint{(ray_C * (beyond_reach * reach_m / length)).cast<float>(), false};
  }
  if (depth_m > 0.0) {
    return PixelPoint{(ray_C * depth_m).cast<float>(), true};
  }
  return std::nullopt;
}

}  // namespace flyball
