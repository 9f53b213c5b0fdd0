// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether the things that a scenario names exist.

#include "scenario_reader.h"
#include <vector>

namespace flyball {

/// Kernels, workload, world, policy, airframe, platform and its operating point. One error each,
/// with the place where the name was given and the command that lists the right ones.
[[nodiscard]] std::vector<Error> check_names(const Scenario& scenario, const GivenValues& given);

/// The world's own parameters (`world.NAME`) as its generator declares them: unknown names, wrong
/// kinds and bounds. On success they are in `scenario`, every one of them.
[[nodiscard]] std::vector<Error> read_world(Scenario& scenario, const GivenValues& given);

/// What the scenario's generator declares; empty when there is no such generator.
[[nodiscard]] std::vector<ParameterSpec> world_parameters(const Scenario& scenario);

}  // namespace flyball
