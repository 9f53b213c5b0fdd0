// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One setting of the knobs on which the latency of a map depends.

namespace flyball {

struct MapSetting {
  double resolution_m{};
  double range_m{};
  double clock_hz{};
  friend bool operator==(const MapSetting& a, const MapSetting& b) {
    return a.resolution_m == b.resolution_m && a.range_m == b.range_m && a.clock_hz == b.clock_hz;
  }
};

}  // namespace flyball
