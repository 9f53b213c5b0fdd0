// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Starts the policy that a C caller asked for.

#include "flyball/governors/governor.h"
#include "flyball/governors/policy.h"

#include <memory>

namespace flyball {

/// @param knobs  What the caller added.
/// @error What is wrong, without line breaks.
[[nodiscard]] Result<std::unique_ptr<Policy>> start_embedded_policy(
    const FlyballGovernorSettings& settings, const KnobSettings& knobs);

}  // namespace flyball
