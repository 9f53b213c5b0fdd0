// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The data sheet of a depth camera, which the vehicle and the simulator both read.

#include "flyball/runtime/messages.h"

namespace flyball {

/// The ideal camera: square pixels, axis through the middle of the image.
[[nodiscard]] Intrinsics pinhole(int width_px, int height_px, double horizontal_field_rad);

struct DepthCameraSpec {
  int width_px{256};
  int height_px{144};
  double horizontal_field_rad{1.5707963267948966};  ///< 90 degrees: MAVBench.
  double rate_hz{20.0};
  double max_range_m{20.0};
  /// sigma = max(0, .0035 d - .0023) for d < 6 m, .0657 d - .4193 beyond: MAVBench's code.
  bool rgbd_noise{true};
  double extra_noise_m{};  ///< Standard deviation at every depth, independent of the other noise.
  int count{1};            ///< Cameras around one place, evenly; the first one looks ahead.
  double forward_m{};      ///< Of that place, from the body's centre; a mount keeps it level.
  double up_m{};
  double pitch_down_rad{};  ///< Of each optical axis.

  [[nodiscard]] Intrinsics intrinsics() const;
};

}  // namespace flyball
