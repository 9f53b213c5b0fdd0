// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/camera_spec.h"

#include <algorithm>
#include <cmath>

namespace flyball {

Intrinsics pinhole(int width_px, int height_px, double horizontal_field_rad) {
  Intrinsics camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.focal_px = 0.5 * width_px / std::tan(0.5 * horizontal_field_rad);
  camera.centre_x_px = 0.5 * (width_px - 1);
  camera.centre_y_px = 0.5 * (height_px - 1);
  return camera;
}

Intrinsics DepthCameraSpec::intrinsics() const {
  return pinhole(width_px, height_px, horizontal_field_rad);
}

namespace {

double rgbd_noise_m(double depth_m) {
  if (depth_m < RgbdNoise::bend_m) {
    return std::max(0.0, RgbdNoise::near_sigma[0] * depth_m + RgbdNoise::near_sigma[1]);
  }
  // The second line begins below zero: what it is at the bend counts until it is as far above.
  const auto far_m = [](double at_m) {
    return std::abs(RgbdNoise::far_sigma[0] * at_m + RgbdNoise::far_sigma[1]);
  };
  return std::max(far_m(RgbdNoise::bend_m), far_m(depth_m));
}

}  // namespace

double DepthCameraSpec::noise_m(double depth_m) const {
  return std::hypot(rgbd_noise ? rgbd_noise_m(depth_m) : 0.0, extra_noise_m);
}

}  // namespace flyball
