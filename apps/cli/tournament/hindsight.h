// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Finds by flights the single setting that is best on the seeds of one world.

#include "flyball/studies/hindsight.h"

#include "cli/race.h"
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// Name of its row among policies.
constexpr const char* fixed_best = "fixed_best";

struct BestSetting {
  Hindsight told{};
  std::vector<Summary> flights{};  ///< Seed by seed, under the name `fixed_best`.
};

/// Halves the settings of the grid, then goes from the best one to its neighbours, also beyond the
/// grid, until none of them is better or a few steps have been made.
/// @param settings  Their flight names the world; the policy is `fixed`.
/// @return          Or the exit code of the command, whose reason has been said.
[[nodiscard]] std::variant<BestSetting, int> find_best_setting(RaceSettings settings,
                                                               FlightStore& store);

}  // namespace flyball
