// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What only a simulator can tell a policy: how long jobs will take that have not begun.

#include <cstddef>
#include <vector>

namespace flyball {

/// One setting of the three knobs that a search for the least energy turns.
struct MapSetting {
  double resolution_m{};
  double range_m{};
  double clock_hz{};
  friend bool operator==(const MapSetting& a, const MapSetting& b) {
    return a.resolution_m == b.resolution_m && a.range_m == b.range_m && a.clock_hz == b.clock_hz;
  }
  friend bool operator!=(const MapSetting& a, const MapSetting& b) { return !(a == b); }
};

/// A place on the way, as the map on board has it now.
struct PlaceAhead {
  double ahead_m{};          ///< Along the committed path and, beyond its end, straight on.
  double speed_limit_m_s{};  ///< The mission's.
  double opening_m{};        ///< The widest opening across the way there.
  double obstacle_m{};       ///< From there to the nearest obstacle; 20 when none is nearer.
};

/// The way ahead, in steps of equal length from where the vehicle is. The durations are true: those
/// of a frame that is taken there in the world as it is, so no vehicle in the field has them.
struct Foresight {
  std::vector<PlaceAhead> places{};
  /// From capture to published map [s], for each place one row: a duration for each setting that
  /// the policy asked for.
  std::vector<double> frame_s{};

  /// Whether each place has a row of so many durations.
  [[nodiscard]] bool is_whole(std::size_t settings) const {
    return frame_s.size() == places.size() * settings;
  }
};

}  // namespace flyball
