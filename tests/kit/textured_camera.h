// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Grey images of the simulator's worlds: each surface has a pattern that depends on where it is,
/// as if it were painted with blocks of several sizes.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/random.h"
#include "flyball/sim/depth_camera.h"

#include <algorithm>
#include <cmath>

namespace flyball::kit {

/// 0..1, the same for all points of one cube of the lattice.
inline double block_value(const Vec3& p_W, double side_m) {
  std::uint64_t h = static_cast<std::uint64_t>(side_m * 1024.0);
  for (int axis = 0; axis < 3; ++axis) {
    // The lattice's planes are kept off the surfaces, which like round numbers.
    const auto cell = static_cast<std::int64_t>(std::floor(p_W[axis] / side_m + 0.37));
    h = (h ^ static_cast<std::uint64_t>(cell)) * 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29U;
    h *= 0xbf58476d1ce4e5b9ULL;
    h ^= h >> 32U;
  }
  return static_cast<double>(h >> 40U) / static_cast<double>(1U << 24U);
}

/// Grey 0..255; blocks that are finer than two pixels fade, as a lens would blur them.
inline double painted(const Vec3& p_W, double pixel_m) {
  double grey = 0.0;
  double total = 0.0;
  for (const double side_m : {0.07, 0.19, 0.47, 1.3}) {
    const double strength = std::clamp(0.5 * side_m / pixel_m - 0.5, 0.0, 1.0);
    grey += strength * block_value(p_W, side_m) + (1.0 - strength) * 0.5;
    total += 1.0;
  }
  return 255.0 * std::clamp(0.5 + 1.2 * (grey / total - 0.5), 0.0, 1.0);
}

inline CameraModel model_of(const Intrinsics& camera) {
  return {camera.width_px, camera.height_px,   camera.focal_px,
          camera.focal_px, camera.centre_x_px, camera.centre_y_px};
}

/// Sees what the simulator's depth camera sees, in grey and, with that camera's noise, in depth.
class TexturedCamera {
 public:
  TexturedCamera(const World& world, DepthCameraSpec spec, std::uint64_t seed)
      : measured_{world, spec, seed}, exact_{world, without_noise(spec), seed}, seed_{seed} {}

  [[nodiscard]] VisualFrame capture(const Pose& X_WC,
                                    MissionTime now,
                                    std::uint64_t sequence) const {
    const DepthImage surface = exact_.capture(X_WC, now, sequence);
    VisualFrame frame;
    frame.captured = now;
    frame.camera = model_of(surface.camera);
    frame.depth_m = measured_.capture(X_WC, now, sequence).depth_m;
    frame.grey.resize(frame.depth_m.size());
    RandomStream noise{seed_, "grey_noise", sequence};
    for (std::size_t i = 0; i < frame.grey.size(); ++i) {
      constexpr double sky = 200.0;
      const auto depth_m = static_cast<double>(surface.depth_m[i]);
      const double grey = std::isfinite(depth_m)
                              ? painted(X_WC * point(surface.camera, static_cast<int>(i), depth_m),
                                        depth_m / surface.camera.focal_px)
                              : sky;
      const double off = noise.uniform(-4.0, 4.0);
      frame.grey[i] = static_cast<std::uint8_t>(std::clamp(grey + off, 0.0, 255.0));
    }
    return frame;
  }

 private:
  static DepthCameraSpec without_noise(DepthCameraSpec spec) {
    spec.rgbd_noise = false;
    spec.extra_noise_m = 0.0;
    spec.max_range_m = 60.0;  // Light comes from farther than depth.
    return spec;
  }
  static Vec3 point(const Intrinsics& camera, int pixel, double depth_m) {
    return depth_m * Vec3{(pixel % camera.width_px - camera.centre_x_px) / camera.focal_px,
                          (pixel / camera.width_px - camera.centre_y_px) / camera.focal_px, 1.0};
  }

  DepthCamera measured_;
  DepthCamera exact_;
  std::uint64_t seed_;
};

}  // namespace flyball::kit
