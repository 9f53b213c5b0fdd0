// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball/runtime/knob.h"

#include <vector>

namespace flyball::kit {

/// The knobs of map and clock; the last clock is the fallback.
inline KnobSettings search_knobs(const std::vector<double>& clocks_hz) {
  KnobSpec resolution;
  resolution.name = "map.resolution_m";
  resolution.min = 0.05;
  resolution.max = 2.0;
  resolution.fallback = 0.15;
  KnobSpec range;
  range.name = "map.range_m";
  range.min = 2.0;
  range.max = 25.0;
  range.fallback = 7.0;
  KnobSpec clock;
  clock.name = "cpu.frequency_hz";
  clock.legal = clocks_hz;
  clock.fallback = clocks_hz.back();
  return KnobSettings{{resolution, range, clock}};
}

}  // namespace flyball::kit
