// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The members of an observation by name, as numbers: for scripts, records and their replay.

#include "flyball/runtime/observation.h"

#include <vector>

namespace flyball {

/// `set(o, get(p))` makes this member of `o` what it is in `p`, bit for bit, for durations below
/// 100 days and counts below 2^53.
struct ObservationField {
  const char* name{};  ///< With its unit: `latency_s`.
  double (*get)(const Observation& seen){};
  void (*set)(Observation& seen, double value){};
  bool is_optional{};  ///< Some computers never say it: then it is 0, and no record mentions it.
  const char* unit{};  ///< `1` where it has none.
  const char* description{};
};

/// Every member but `now`, in the order of `Observation`; `phase` as its number.
[[nodiscard]] const std::vector<ObservationField>& observation_fields();

/// `take_off`, `cruise`, `land`, `wait`.
[[nodiscard]] const char* to_string(MissionPhase phase);

}  // namespace flyball
