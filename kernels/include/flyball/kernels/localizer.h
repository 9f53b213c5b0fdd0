// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Localization: what the navigation sensors say in, a pose out.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/work.h"

namespace flyball {

/// Where W's origin lies on the earth.
struct GeodeticOrigin {
  double latitude_rad{0.8290};   ///< 47.5 degrees north.
  double longitude_rad{0.1484};  ///< 8.5 degrees east.
  double height_m{400.0};
};

class Localizer : public Kernel {
 public:
  virtual void start(const GeodeticOrigin& origin) = 0;
  /// Samples arrive in order of their stamps. Adds `samples` to `work`.
  [[nodiscard]] virtual PoseEstimate estimate(const NavigationSample& sample, Work& work) = 0;
};

}  // namespace flyball
