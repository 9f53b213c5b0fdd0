// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Depth camera: rays into the true world.

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
  /// sigma = max(0, .0035 d - .0023) for d < 6 m, .0657 d - .4193 beyond: MAVBench's code.
  bool rgbd_noise{true};
  double extra_noise_m{};  ///< Standard deviation at every depth, independent of the other noise.
  int count{1};            ///< Cameras around one place, evenly; the first one looks ahead.
  double forward_m{};      ///< Of that place, from the body's centre; a mount keeps it level.
  double up_m{};
  double pitch_down_rad{};  ///< Of each optical axis.

  [[nodiscard]] Intrinsics intrinsics() const;
};

/// One thread, arithmetic as IEEE 754 rounds it: the same image on every processor.
class DepthCamera {
 public:
  DepthCamera(const World& world, const DepthCameraSpec& spec, std::uint64_t seed);
  ~DepthCamera();
  DepthCamera(const DepthCamera&) = delete;
  DepthCamera& operator=(const DepthCamera&) = delete;

  /// The image seen from `X_WC` (C: x right, y down, z forward). Pixel (u, v) looks along
  /// ((u - centre_x) / focal, (v - centre_y) / focal, 1). Noise depends on the seed and `sequence`
  /// only, not on how many frames were read before; a depth that it carries beyond the range is no
  /// return, one below 5 cm becomes 5 cm.
  ///
  /// @cost .2 ms for 256 x 144 pixels on one x86 core; see sim/README.md.
  [[nodiscard]] DepthImage capture(const Pose& X_WC, MissionTime now, std::uint64_t sequence) const;
  /// The same image, and those of the other cameras of the spec, captured when somebody looks at
  /// them. @pre The camera lives until then.
  [[nodiscard]] DepthFrame frame(const Pose& X_WC, MissionTime now, std::uint64_t sequence) const;
  [[nodiscard]] const DepthCameraSpec& spec() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace flyball
