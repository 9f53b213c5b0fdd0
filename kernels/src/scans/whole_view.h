// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether a depth image shows that a cube is empty.
///
/// A ray that crosses a cube says that the cube is empty along that ray. A wall may fill the rest
/// of it, and the camera may look past that wall for as long as the vehicle stands still. So a cube
/// is only seen through if the image shows all of it, and if every pixel that looks into it sees
/// something behind it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/messages.h"

#include <optional>

namespace flyball {

class WholeView {
 public:
  /// @param pixels   Their image must outlive the questions, and has a depth for each pixel.
  /// @param range_m  What is farther away was not looked at.
  WholeView(const RangeImage& pixels, const Pose& X_WC, double range_m);

  /// @cost In proportion to the pixels that the cube covers.
  [[nodiscard]] bool sees_through(const Aabb& cube) const;

 private:
  /// Pixels with their bounds, both inclusive.
  struct Pixels {
    int u0;
    int v0;
    int u1;
    int v1;
  };
  /// Those that may look into the cube. Nothing if a part of it is out of view or out of range.
  [[nodiscard]] std::optional<Pixels> pixels_of(const Aabb& cube) const;

  const DepthImage& image_;
  Pose X_WC_;
  double range_m_;
};

}  // namespace flyball
