// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a scan photographs, and what it says of each picture.

#include "flyball/flight/flight_settings.h"
#include "flyball/flight/mission_context.h"
#include "flyball/runtime/time.h"

namespace flyball {

constexpr double scan_cell_m = 0.5;  ///< Of the grid that coverage is counted on.

/// A picture was taken with the camera that looks down.
struct GroundPicture {
  MissionTime taken{};
};

/// On the ground, in the middle of the brief's bounds; without height.
[[nodiscard]] inline Aabb scanned_area_W(const MissionBrief& brief, const ScanSettings& scan) {
  const Vec3 centre_W = 0.5 * (brief.bounds_W.min + brief.bounds_W.max);
  const Vec3 corner_W{centre_W.x() - 0.5 * scan.length_m, centre_W.y() - 0.5 * scan.width_m,
                      brief.ground_z_m};
  return {corner_W, corner_W + Vec3{scan.length_m, scan.width_m, 0.0}};
}

}  // namespace flyball
