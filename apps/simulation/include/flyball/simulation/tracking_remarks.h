// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether an autopilot flew as well as its flight relied on.

#include "flyball/records/summary.h"
#include "flyball/scenario/scenario.h"

#include <string>
#include <vector>

namespace flyball {

/// Sentences where the autopilot did not fly as well as the scenario says. A vehicle that is
/// farther off its path is waited for, and near obstacles room is needed for what it really keeps.
[[nodiscard]] std::vector<std::string> tracking_remarks(const Summary& summary,
                                                        const Scenario& scenario);

/// Gives the scenario settings with which an autopilot that nobody has tuned flies without hitting
/// what it sees, where its own are less careful. ArduCopter in its simulation kept its path within
/// .18 m and braked .13 s late with them; at 10 m/s and 6 m/s^2 it hit trees, 1 s late.
/// @param kept  Keys of settings that stay as they are.
/// @return      What was changed: KEY=VALUE.
std::vector<std::string> make_careful(Scenario& scenario, const std::vector<std::string>& kept);

}  // namespace flyball
