// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Coverage: an area in, a path over all of it out.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <vector>

namespace flyball {

struct CoverageRequest {
  Vec3 corner_W{Vec3::Zero()};  ///< Of the area, least x and y; its z is the height of flight.
  double length_m{};            ///< Along x, as the lanes run.
  double width_m{};             ///< Along y, across the lanes.
  int lanes{};
  Vec3 start_W{Vec3::Zero()};  ///< Where the vehicle comes from, at the height of flight,
  Vec3 end_W{Vec3::Zero()};    ///< and where it goes afterwards.
};

struct CoveragePath {
  std::vector<Vec3> waypoints_W{};  ///< From start over the area to end.
  double out_m{};                   ///< From the start to where the area is entered,
  double back_m{};                  ///< and from where it is left to the end.
  Work work{};                      ///< `waypoints`
};

class CoveragePlanner : public Kernel {
 public:
  /// A strip of width / lanes on both sides of the path covers the area. Same request, same path.
  ///
  /// @error `invalid_input` for an area without extent, no lane, or a place that is not finite.
  [[nodiscard]] virtual Result<CoveragePath> cover(const CoverageRequest& request) = 0;
};

}  // namespace flyball
