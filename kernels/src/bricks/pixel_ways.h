// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The rays through the middles of an image's pixels, held against a box in W.

#include "flyball/runtime/geometry.h"

#include "depth_pyramid.h"
#include "inner_loops.h"
#include <array>
#include <optional>
#include <vector>

namespace flyball {

class PixelWays {
 public:
  /// @param depths  Where each pixel's ray ends, if not at the range. Must outlive the questions.
  void aim(const DepthPyramid& depths, const Pose& X_WC, double range_m);
  /// @param box  From the eye, in W.
  [[nodiscard]] Crossing cross(const BoxOfCell& box,
                               const PixelBlock& pixels,
                               const InnerLoops& loops) const;
  /// Appends the pixels whose rays perhaps cross the box and end behind it: all of those, and some
  /// more.
  void append_doubtful(const BoxOfCell& box,
                       const PixelBlock& pixels,
                       const InnerLoops& loops,
                       std::vector<int>& numbers) const;
  /// Which of the points of C is seen in a pixel.
  /// @param in_rows  They are taken to come row by row, which is faster: others are not found.
  [[nodiscard]] std::optional<std::size_t> find(int pixel,
                                                const std::vector<Eigen::Vector3f>& points_C,
                                                bool in_rows) const;

 private:
  [[nodiscard]] int pixel_of(const Eigen::Vector3f& p_C) const;

  void measure(const PixelGrid& grid, double range_m);

  PixelGrid grid_{};
  double measured_m_{};  ///< The range for which `range_m_` was made.
  PixelProbe probe_{};
  std::vector<double> slope_x_{};
  std::vector<double> slope_y_{};
  std::array<std::vector<float>, 3> column_W_{};
  std::array<std::vector<float>, 3> row_W_{};
  std::vector<float> range_m_{};  ///< As a depth, for each pixel.
};

}  // namespace flyball
