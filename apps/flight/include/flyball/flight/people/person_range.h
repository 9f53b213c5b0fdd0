// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How far away a person is, as a box in a picture tells.

#include "flyball/runtime/colour_frame.h"

#include <optional>

namespace flyball {

/// What is known of somebody who stands upright on level ground.
struct PersonGeometry {
  double height_m{1.75};
  double camera_above_m{};  ///< Of the camera above the person's feet.
};

/// Two answers to one question, along the ground.
struct PersonRange {
  /// The tangents of the lines of sight to head and feet differ by height over distance.
  double by_size_m{};
  /// Where the line of sight to the box's middle is at half the person's height; empty when it is
  /// too flat to tell.
  std::optional<double> by_ground_m{};
};

[[nodiscard]] PersonRange person_range(const ImageBox& box,
                                       const ColourFrame& frame,
                                       const PersonGeometry& person);

/// False when the two answers contradict each other: a trunk, a shadow, whatever has not the size
/// of a person at its place on the ground.
[[nodiscard]] bool is_plausible(const PersonRange& range);

}  // namespace flyball
