// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The files that a mission reads.

#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"

#include <string>
#include <vector>

namespace flyball {

/// Those that the scenario names: airframe, platforms, policy, map or mesh, libraries. The file of
/// the scenario itself, which it does not know, is not among them.
[[nodiscard]] std::vector<std::string> files_of_mission(const Scenario& scenario);

/// Of the content of `files_of_mission`: these numbers are part of the mission.
[[nodiscard]] std::string data_fingerprint(const Scenario& scenario);

/// Ask before flying: what a command writes may not be what its mission reads.
///
/// @param inputs   What the command reads beside `files_of_mission`. An empty one is none.
/// @param outputs  What it writes. An empty one is none.
/// @error `invalid_input` when an output is one of the files that are read.
[[nodiscard]] Status keep_inputs(const Scenario& scenario,
                                 const std::vector<std::string>& inputs,
                                 const std::vector<std::string>& outputs);

}  // namespace flyball
