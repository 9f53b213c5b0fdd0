// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A depth image and, at every coarser scale, the least and the greatest depth: how far a block of
/// pixels can be seen through, answered with a few look-ups whatever the block's size.

#include "flyball/runtime/messages.h"

#include "inner_loops.h"
#include <cstddef>
#include <vector>

namespace flyball {

/// Least and greatest depth in a block of pixels [m].
struct DepthSpan {
  float least;
  float most;
};

class DepthPyramid {
 public:
  /// Puts the cloud's points back into the pixels from which they came. A pixel without a point has
  /// depth 0: nothing was seen there. One that is clear up to `range_m` has depth infinity.
  ///
  /// @pre The cloud has a camera.
  void build(const PointCloud& cloud_C, double range_m, const InnerLoops& loops);

  /// The same in two steps, for callers that have the depths: returns where they go, row by row.
  float* begin(const Intrinsics& camera);
  void finish(const InnerLoops& loops);

  [[nodiscard]] const PixelGrid& grid() const { return grid_; }
  /// The finest scale, row by row.
  [[nodiscard]] const float* depth_m() const { return depth_m_.data(); }
  /// From the finest scale to a single texel.
  [[nodiscard]] const std::vector<DepthScale>& scales() const { return views_; }
  /// @pre The block lies in the image. May look at pixels beside it: up to a texel on each side, of
  ///      which `texels` or one more cover the block's width.
  [[nodiscard]] DepthSpan span(const PixelBlock& block, int texels = 1) const;

 private:
  struct Scale {
    std::size_t first;  ///< In `least_m_` and `most_m_`; nothing there for the finest scale.
    int width;
    int height;
  };
  void lay_out(const Intrinsics& camera);
  void put(const std::vector<Eigen::Vector3f>& points_C, float range_m, const InnerLoops& loops);
  void build_scale(std::size_t scale, const InnerLoops& loops);
  [[nodiscard]] DepthRows rows(std::size_t scale, int upper, int lower) const;

  PixelGrid grid_{};
  std::vector<Scale> scales_{};
  std::vector<DepthScale> views_{};  ///< Of `scales_`.
  std::vector<float> depth_m_{};     ///< The finest scale, and spare pixels.
  std::vector<float> least_m_{};     ///< The others, one after the other, and spare texels.
  std::vector<float> most_m_{};
};

}  // namespace flyball
