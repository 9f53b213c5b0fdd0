// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How far away a person is, derived from a box in an image.

#include "flyball/runtime/colour_frame.h"

#include <optional>

namespace flyball {

/// A person who stands upright on level ground.
struct PersonGeometry {
  double height_m{1.75};
  double camera_above_m{};  ///< Height of the camera above the person's feet.
};

/// Two independent estimates of the distance along the ground.
struct PersonRange {
  /// From the size of the box: the tangents of the lines of sight to head and feet differ by height
  /// over distance.
  double by_size_m{};
  /// Where the line of sight to the middle of the box is at half the person's height. Empty when
  /// the line is too flat to tell.
  std::optional<double> by_ground_m{};
};

[[nodiscard]] PersonRange person_range(const ImageBox& box,
                                       const ColourFrame& frame,
                                       const PersonGeometry& person);

/// False when the two estimates contradict each other: then the box shows a trunk, a shadow, or
/// something else that has not a person's size at its place on the ground.
[[nodiscard]] bool is_plausible(const PersonRange& range);

}  // namespace flyball
