// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One decision as one line of text, for whoever keeps a record.

#include "flyball/governors/governor.h"
#include "flyball/runtime/observation.h"

#include "callers_knobs.h"
#include <array>

namespace flyball {

/// Words `name=value`: time, mode, reason, fallback; each knob as decided, and as it is in force
/// where that differs; each signal that is not 0; last `why` in quotes, where there is a reason.
/// Numbers can be read back to the bit. Allocates nothing; what does not fit is cut off.
void write_decision_line(std::array<char, 8192>& line,
                         const FlyballGovernorDecision& answer,
                         const CallersKnobs& knobs,
                         const Observation& seen) noexcept;

}  // namespace flyball
