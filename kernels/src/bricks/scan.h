// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A range scan as OctoMap takes it.

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

}  // namespace flyball
