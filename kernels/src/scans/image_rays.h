// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The rays through the middles of a depth image's pixels: as points of C, and held against a box
/// in W.

#include "flyball/kernels/pixel_point.h"
#include "flyball/runtime/geometry.h"
#include "flyball/runtime/messages.h"

#include "inner_loops.h"
#include <array>
#include <optional>
#include <vector>

namespace flyball {

class ImageRays {
 public:
  /// @param image    Must outlive the questions. @param reach_m  As RangeImage's.
  /// @param range_m  Rays are cut there.
  void look(const DepthImage& image, double reach_m, double range_m);
  /// Where the rays end, as a depth pyramid wants it: see InnerLoops::lay_depths.
  /// @param ends_m         Room for all pixels and sixteen more; must outlive the questions about
  ///                       boxes.
  /// @param range_doubt_m  By which rays that are cut may be longer or shorter.
  void lay_ends(const Pose& X_WC, double range_doubt_m, float* ends_m, const InnerLoops& loops);

  [[nodiscard]] int width_px() const { return static_cast<int>(slope_x_.size()); }
  [[nodiscard]] int height_px() const { return static_cast<int>(slope_y_.size()); }
  /// Sixteen pixels of a row; those beyond its end are no rays.
  void points_from(
      int u, int v, PointBlock& points, PixelKinds& kinds, const InnerLoops& loops) const;
  /// The same point that the point cloud has for this pixel.
  [[nodiscard]] std::optional<PixelPoint> point(int pixel) const;

  /// Whether any pixel looks to that side, -1 or 1, along an axis of W.
  [[nodiscard]] bool any_towards(std::size_t axis, int side) const;
  /// @param box  From the camera, in W.
  [[nodiscard]] Crossing cross(const BoxOfCell& box,
                               const PixelBlock& pixels,
                               const InnerLoops& loops) const;
  /// Appends the pixels whose rays perhaps cross the box and end behind it: all of those, and some
  /// more.
  void append_doubtful(const BoxOfCell& box,
                       const PixelBlock& pixels,
                       const InnerLoops& loops,
                       std::vector<int>& numbers) const;

 private:
  void measure(const Intrinsics& camera);
  void scale(double length_m, std::vector<float>& depths_m) const;
  [[nodiscard]] PixelDepths depths_from(std::size_t pixel) const;

  const DepthImage* image_{};
  Intrinsics camera_{};  ///< For which the slopes were measured,
  double reach_m_{};     ///< and the depths.
  double range_m_{};
  std::vector<double> slope_x_{};
  std::vector<double> slope_y_{};
  std::vector<float> column_x_{};  ///< `slope_x_`, and room for a vector.
  std::vector<double> lengths_{};  ///< Of each pixel's ray at depth 1.
  std::vector<float> reach_depths_m_{};
  std::vector<float> clear_depths_m_{};
  std::vector<float> range_depths_m_{};
  std::array<std::vector<float>, 3> column_W_{};
  std::array<std::vector<float>, 3> row_W_{};
  PixelProbe probe_{};
};

}  // namespace flyball
