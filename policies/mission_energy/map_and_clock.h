// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The two parts with which `mission_energy` decides, and `reference` where it is told nothing.

#include "flyball/governors/clock_search.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include "map_rule.h"
#include <string>
#include <vector>

namespace flyball {

/// The map by a rule, and then the clock with the least energy per metre for that map.
struct MapAndClock {
  MapRule map;
  ClockSearch clock;

  /// A policy adds them to its own.
  [[nodiscard]] static std::vector<ParameterSpec> parameters();
  /// @param owner     For messages: `policy "mission_energy"`.
  /// @param given     Those of `parameters`.
  /// @param latency   If the policy refuses its own parameters, that is told after what is missing.
  /// @error `invalid_input`: a knob or the board's power is missing, or parameters contradict each
  ///        other or the knobs.
  static Result<MapAndClock> make(const std::string& owner,
                                  const Parameters& given,
                                  const KnobSettings& knobs,
                                  const BoardModel& board,
                                  const Result<LearnedLatencySettings>& latency);
};

}  // namespace flyball
