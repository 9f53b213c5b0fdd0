// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a scan photographs, and what it says of each picture.

#include "flyball/flight/brief.h"
#include "flyball/flight/exploration/ground_coverage.h"
#include "flyball/flight/flight_settings.h"
#include "flyball/runtime/time.h"

#include <optional>

namespace flyball {

constexpr double scan_cell_m = 0.5;  ///< Of the grid that coverage is counted on.

/// A picture was taken with the camera that looks down.
struct GroundPicture {
  MissionTime taken{};
  /// By the pose that the vehicle believes; empty where the picture shows the horizon.
  std::optional<Footprint> footprint{};
};

/// On the ground, in the middle of the brief's bounds; without height.
[[nodiscard]] inline Aabb scanned_area_W(const Site& site, const ScanSettings& scan) {
  const Vec3 centre_W = 0.5 * (site.bounds_W.min + site.bounds_W.max);
  const Vec3 corner_W{centre_W.x() - 0.5 * scan.length_m, centre_W.y() - 0.5 * scan.width_m,
                      site.ground_z_m};
  return {corner_W, corner_W + Vec3{scan.length_m, scan.width_m, 0.0}};
}

}  // namespace flyball
