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
  /// @return         Points in C, those of the side views too. Adds `pixels` to `work`.
  ///
  /// Where the work does not depend on what the pixels show, neither they nor the points are
  /// computed before somebody looks at the cloud; an implementation whose work does depend on them
  /// looks at once. The result may outlive the builder.
  [[nodiscard]] virtual PointCloudFrame build(const DepthFrame& frame,
                                              double range_m,
                                              Work& work) = 0;
};

}  // namespace flyball
