// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a colour camera sees.

#include "flyball/runtime/deferred.h"
#include "flyball/runtime/geometry.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <vector>

namespace flyball {

/// One picture: red, green, blue, 8 bits each, row by row.
struct ColourImage {
  MissionTime captured{};
  std::uint64_t sequence{};
  Intrinsics camera{};
  std::vector<std::uint8_t> rgb{};
};

/// A picture as the sensor publishes it; rendered only if somebody looks at it.
struct ColourFrame {
  MissionTime captured{};
  std::uint64_t sequence{};
  Intrinsics camera{};
  /// Where the gimbal held the camera, by its own encoders: pose in the level frame L, which has
  /// the body's origin and heading and stands upright.
  Pose X_LC{Pose::Identity()};
  Pose X_WC_truth{Pose::Identity()};  ///< For error statistics only.
  Deferred<ColourImage> image{};
};

/// Rectangle in an image; the pixel (u, v) covers [u, u + 1) x [v, v + 1).
struct ImageBox {
  double x_px{};  ///< Left edge.
  double y_px{};  ///< Upper edge.
  double width_px{};
  double height_px{};

  [[nodiscard]] double centre_x_px() const { return x_px + 0.5 * width_px; }
  [[nodiscard]] double centre_y_px() const { return y_px + 0.5 * height_px; }
  [[nodiscard]] double area_px2() const { return width_px * height_px; }
};

/// Intersection over union, 0..1; zero for boxes without area.
[[nodiscard]] double overlap(const ImageBox& a, const ImageBox& b);

}  // namespace flyball
