// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Depth image in, points out.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/work.h"

namespace flyball {

class PointCloudBuilder : public Kernel {
 public:
  /// Back-projects every pixel. A pixel without return, or beyond `range_m`, becomes a clear ray
  /// of that length.
  ///
  /// @param range_m  Positive; longer than the sensor's range is cut to it.
  /// @return         Points in C. Adds `pixels` to `work`.
  [[nodiscard]] virtual PointCloud build(const DepthImage& image, double range_m, Work& work) = 0;
};

}  // namespace flyball
