// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The data sheet of a depth camera, which the vehicle and the simulator both read.

#include "flyball/runtime/messages.h"

#include <array>
#include <cmath>

namespace flyball {

/// The ideal camera: square pixels, axis through the middle of the image.
[[nodiscard]] Intrinsics pinhole(int width_px, int height_px, double horizontal_field_rad);

/// MAVBench's RGB-D camera (its code): a depth d is wrong by a d + b times a normal number. At 6 to
/// 6.38 m its second line is below zero, which is as good as its size; the first one is cut at 0.
struct RgbdNoise {
  static constexpr double bend_m = 6.0;  ///< From here on the second line holds.
  static constexpr std::array<double, 2> near_sigma{0.0035, -0.0023};  ///< a, b [m]
  static constexpr std::array<double, 2> far_sigma{0.0657, -0.4193};
};

struct DepthCameraSpec {
  int width_px{256};
  int height_px{144};
  double horizontal_field_rad{1.5707963267948966};  ///< 90 degrees: MAVBench.
  double rate_hz{20.0};
  double max_range_m{20.0};
  bool rgbd_noise{true};   ///< As `RgbdNoise`.
  double extra_noise_m{};  ///< Standard deviation at every depth, independent of the other noise.
  int count{1};            ///< Cameras around one place, evenly; the first one looks ahead.
  double forward_m{};      ///< Of that place, from the body's centre; a mount keeps it level.
  double up_m{};
  double pitch_down_rad{};  ///< Of each optical axis.
  double delay_s{};         ///< From the moment that an image shows to its message.

  [[nodiscard]] Intrinsics intrinsics() const;
  /// Standard deviation of a depth [m], or of a smaller one where that is larger: it does not fall
  /// with the depth.
  [[nodiscard]] double noise_m(double depth_m) const;
};

/// A frame passes this share of the wanted interval after the last one, so that a 20 Hz camera
/// satisfies a 20 Hz knob although its stamps are rounded.
inline constexpr double least_share_of_interval = 0.9;

/// The interval between frames behind a limit [s], of frames that arrive at an even interval before
/// it. @pre Both are positive.
[[nodiscard]] inline double passed_interval_s(double interval_s, double rate_hz) {
  constexpr double rounding = 1e-9;  // 4 x .05 s are a little more than .2 s.
  const double frames = least_share_of_interval / (rate_hz * interval_s);
  return std::fmax(1.0, std::ceil(frames - rounding)) * interval_s;
}

}  // namespace flyball
