// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Depth camera: Embree rays into the true world.

#include "flyball/runtime/messages.h"
#include "flyball/sim/world.h"

#include <memory>

namespace flyball {

struct DepthCameraSpec {
  int width_px{256};
  int height_px{144};
  double horizontal_field_rad{1.5707963267948966};  ///< 90 degrees: MAVBench.
  double rate_hz{20.0};
  double max_range_m{20.0};
  /// Depth noise: `none`, or `rgbd` (sigma = max(0, .0035 d - .0023) for d < 6 m, .0657 d - .4193
  /// beyond: MAVBench's code), plus `extra_noise_m` of standard deviation at every depth.
  bool rgbd_noise{true};
  double extra_noise_m{};

  [[nodiscard]] Intrinsics intrinsics() const;
};

/// One thread, fixed instruction set: the same image on every host of a CPU class.
class DepthCamera {
 public:
  DepthCamera(const World& world, const DepthCameraSpec& spec, std::uint64_t seed);
  ~DepthCamera();
  DepthCamera(const DepthCamera&) = delete;
  DepthCamera& operator=(const DepthCamera&) = delete;

  /// The image seen from `X_WC` (C: x right, y down, z forward). Noise depends on the seed and
  /// `sequence` only, not on how many frames were read before.
  [[nodiscard]] DepthImage capture(const Pose& X_WC, MissionTime now, std::uint64_t sequence) const;
  [[nodiscard]] const DepthCameraSpec& spec() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace flyball
