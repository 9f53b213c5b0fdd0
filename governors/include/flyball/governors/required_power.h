// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The computer's power, for a policy that cannot do without.

#include "flyball/runtime/board.h"
#include "flyball/runtime/result.h"

#include <string>

namespace flyball {

/// @param owner  For the message: `policy "mission_energy"`.
/// @error `invalid_input` where the board does not tell its power, or tells a number that no
/// computer has; the sentence says what to pass.
[[nodiscard]] Result<PowerCost> required_power(const std::string& owner, const BoardModel& board);

}  // namespace flyball
