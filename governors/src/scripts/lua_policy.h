// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy that is a Lua script:
///
///     description = "Fine among obstacles"
///     period_s = 0.25                                  -- optional
///     parameters = {{name = "fine_m", default = 0.15, min = 0.05, max = 2, description = "..."}}
///     function start(given, knobs, board) ... end      -- optional; error("why") refuses
///     function decide(seen)
///       return {["map.resolution_m"] = 0.15}, "density"  -- wishes, and a reason
///     end
///
/// `given` has the parameters; `knobs[name]` has unit, min, max, legal, default and value; `board`
/// is what is known of the computer: `board.cores`, `board.switching_s`, `board.clocks`, a list of
/// {hz, idle_w, busy_core_w} with all cores on, `board.off_core_w`, which each core that is
/// switched off saves, `board.memory_contention`, and `board.thermal` with ambient_c,
/// resistance_k_w, time_constant_s and the list `trips` of {at_c, hysteresis_k, cap_hz}. What is
/// not known is nil. `seen` has `now_s`, `phase` and the members of the observation, and is the
/// same table in each decision.

#include "flyball/governors/policy.h"

#include <memory>
#include <string>

namespace flyball {

/// @param seed  Of `math.random`.
/// @error `not_found`; `invalid_input` with file and line; `unavailable` without Lua.
[[nodiscard]] Result<std::unique_ptr<Policy>> open_lua_policy(const std::string& path,
                                                              std::uint64_t seed);

}  // namespace flyball
