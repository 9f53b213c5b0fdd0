// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Frames for map benchmarks: a camera of 90 degrees that flies down a corridor into a hall, or
/// over open ground between blocks. Depths by closed-form intersection, with .1 % of noise.

#include "flyball/runtime/messages.h"

#include "scans/scan.h"
#include <vector>

#include <octomap/Pointcloud.h>

namespace flyball::bench {

enum class Scene { indoor, outdoor };

struct ImageSize {
  int width_px;
  int height_px;
};

/// One frame, as the kernels get it and as OctoMap gets it.
struct Frame {
  PointCloud cloud_C;
  PointCloudFrame pixels;  ///< The same as an image.
  Pose X_WC;
  Scan scan;
  octomap::Pointcloud points_W;
};

inline constexpr double scene_range_m = 20.0;
inline constexpr int flight_frames = 50;

/// Every `stride`-th frame of the flight.
[[nodiscard]] std::vector<Frame> frames_of(Scene scene, ImageSize size, int stride);

/// The space that the flight maps: where questions are asked.
[[nodiscard]] Aabb flight_space(Scene scene);

}  // namespace flyball::bench
