// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A range scan as OctoMap takes it.

#include "flyball/kernels/mapper.h"

#include <string>
#include <vector>

#include <octomap/octomap_types.h>

namespace flyball {

/// Rays of one scan in W.
struct Scan {
  octomap::point3d origin_W{};
  std::vector<octomap::point3d> hits_W{};
  std::vector<octomap::point3d> clear_W{};  ///< Ends of rays that met nothing.
  double range_m{};                         ///< Rays are cut there, and then mark nothing.
};

/// Into the world, rounded to floats as stock OctoMap gets them.
void to_world(const PointCloud& cloud_C, const Pose& X_WC, Scan& scan);

/// The greatest float whose root, in double, is at most `length`: a length that octomath computes
/// (the root of a square in float) is held against the range without a root.
[[nodiscard]] float greatest_square(double length);

/// What is checked of a camera's place and range whatever the map.
///
/// @param cell_m  Of the cells that its rays cross.
/// @param edge_m  The camera must be nearer to the map's centre along each axis.
/// @error `invalid_input` with what is wrong.
[[nodiscard]] Status check_view(const Pose& X_WC,
                                const MapperSettings& settings,
                                double cell_m,
                                double edge_m);
/// @error `invalid_input` for a point or a pose that is not finite.
[[nodiscard]] Status check_points(const PointCloud& cloud_C, const Pose& X_WC);
/// Whether the image of a frame has a depth for each pixel; frames without one have nothing to
/// check.
[[nodiscard]] Status check_image(const PointCloudFrame& frame);

}  // namespace flyball
