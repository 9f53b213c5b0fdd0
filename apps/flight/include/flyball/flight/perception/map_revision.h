// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A published map.

#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <limits>
#include <memory>

namespace flyball {

struct MapRevision {
  std::uint64_t number{};
  MissionTime captured{};  ///< Of the newest frame in it.
  double resolution_m{};
  /// Never changes. Owners: the message, and readers that go on with this revision while newer ones
  /// come.
  std::shared_ptr<const OccupancyView> map{};
  double range_m{};  ///< Of the newest frame in it; 0: nobody says.
  double bytes{};    ///< On a link; 0 where there is none.
  /// That its mapper takes at this resolution, whatever the knob of the range says.
  double longest_range_m{std::numeric_limits<double>::infinity()};
};

[[nodiscard]] inline double wire_bytes(const MapRevision& revision) {
  return revision.bytes;
}

}  // namespace flyball
