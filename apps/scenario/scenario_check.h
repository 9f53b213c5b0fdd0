// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Checks that everything a scenario names exists.

#include "scenario/scenario_reader.h"
#include <vector>

namespace flyball {

/// Kernels, workload, world, policy, airframe, platform and its operating point. One error each,
/// with the place where the name was given and the command that lists the right ones.
[[nodiscard]] std::vector<Error> check_names(const Scenario& scenario, const GivenValues& given);

/// Whether the scenario's mapper maps at the scenario's resolution and range.
///
/// @param corners_W  Of the world, where there is one: whether it maps from there, too.
[[nodiscard]] std::vector<Error> check_map(const Scenario& scenario,
                                           const GivenValues& given,
                                           const std::vector<Vec3>& corners_W = {});

}  // namespace flyball
