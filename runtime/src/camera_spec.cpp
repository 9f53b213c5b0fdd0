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

double DepthCameraSpec::noise_m(double depth_m) const {
  const auto& [a, b_m] = depth_m < RgbdNoise::bend_m ? RgbdNoise::near_sigma : RgbdNoise::far_sigma;
  return std::hypot(rgbd_noise ? std::max(0.0, a * depth_m + b_m) : 0.0, extra_noise_m);
}

}  // namespace flyball
