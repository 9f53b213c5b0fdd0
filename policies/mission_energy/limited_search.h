// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How policies begin that search for the least energy within the mission's limits.

#include "flyball/governors/energy_search.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include "mission_limits.h"
#include <string>

namespace flyball {

/// The two parts that such a policy has.
struct LimitedSearch {
  MissionLimits limits;
  EnergySearch search;

  /// @param owner     For messages: `policy "mission_energy"`.
  /// @param given     Those of `MissionLimits::parameters`, `fine_latency_s` and
  ///                  `coarse_latency_s`.
  /// @param settings  Their reaction time becomes the vehicle's, and their spacing that of a forest
  ///                  at least. If the policy refuses its own
  ///                  parameters, that is told after what is missing.
  /// @error `invalid_input`: a knob or the board's power is missing, or parameters contradict each
  ///        other or the knobs.
  static Result<LimitedSearch> make(const std::string& owner,
                                    const Parameters& given,
                                    const KnobSettings& knobs,
                                    const BoardModel& board,
                                    Result<EnergySearchSettings> settings);
};

}  // namespace flyball
