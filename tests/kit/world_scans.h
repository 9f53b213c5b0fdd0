// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The synthetic scans in W, as OctoMap takes them.

#include "scans/scan.h"
#include "synthetic_scans.h"

namespace flyball::kit {

inline octomap::point3d to_octomap(const Vec3& p) {
  const Eigen::Vector3f single = p.cast<float>();
  return {single.x(), single.y(), single.z()};
}

inline Scan world_scan(Place place, int frame, double range_m, int width_px = 64) {
  const SyntheticScan from = synthetic_scan(place, frame, range_m, width_px);
  Scan scan;
  for (const auto& p_C : from.cloud_C.hits_C) {
    scan.hits_W.push_back(to_octomap(from.X_WC * p_C.cast<double>()));
  }
  for (const auto& p_C : from.cloud_C.clear_C) {
    scan.clear_W.push_back(to_octomap(from.X_WC * p_C.cast<double>()));
  }
  scan.origin_W = to_octomap(from.X_WC.translation());
  scan.range_m = range_m;
  return scan;
}

inline octomap::Pointcloud points_of(const Scan& scan) {
  octomap::Pointcloud points;
  for (const auto* ends : {&scan.hits_W, &scan.clear_W}) {
    for (const auto& p : *ends) {
      points.push_back(p);
    }
  }
  return points;
}

}  // namespace flyball::kit
