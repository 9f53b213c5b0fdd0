// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Starts the policy that a C caller asked for.

#include "flyball/governors/governor.h"
#include "flyball/governors/policy.h"
#include "flyball/runtime/time.h"

#include <memory>

namespace flyball {

/// @param knobs          What the caller added.
/// @param reaction_time  The guard's, for policies that reckon with a safe speed.
/// @error What is wrong, without line breaks.
[[nodiscard]] Result<std::unique_ptr<Policy>> start_embedded_policy(
    const FlyballGovernorSettings& settings, const KnobSettings& knobs, Duration reaction_time);

}  // namespace flyball
