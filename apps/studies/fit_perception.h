// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the recorded scenes have in common: a vehicle that is put somewhere and looks.

#include "flyball/sim/depth_camera.h"

#include "simulation/mission_setup.h"
#include "studies/fit_scenes.h"

namespace flyball {

[[nodiscard]] Pose looking(const Vec3& p_W, double yaw_rad);

/// Camera, point cloud and map: what is done with one view.
class Perception {
 public:
  /// Workbench and world outlive it.
  Perception(const Workbench& bench, const World& world)
      : bench_{bench}, camera_{world, bench.brief.settings.camera, bench.brief.settings.seed} {}

  /// Looks from `X_WB`; the frame is in the map afterwards.
  Status look(const Pose& X_WB, KernelLoads& loads);
  /// The newest view at another resolution; the map stays as it is.
  Result<Work> prepare(double resolution_m);

 private:
  [[nodiscard]] double range_m() const { return bench_.brief.settings.map.range_m; }

  const Workbench& bench_;
  DepthCamera camera_;
  PointCloudFrame view_{};
  Pose X_WC_{Pose::Identity()};
  std::uint64_t frames_{};
};

}  // namespace flyball
