// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a scenario says of a computer that is not on board.

#include "flyball/runtime/edge.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/result.h"

#include "scenario/scenario_fields.h"
#include "scenario/scenario_reader.h"
#include <optional>
#include <vector>

namespace flyball {

[[nodiscard]] bool has_edge(const Scenario& scenario);

/// The keys of `[edge]` and `[offload]`.
[[nodiscard]] std::vector<ScenarioField> edge_fields();

/// Whether the edge computer exists, and whether nodes are moved only where there is one.
[[nodiscard]] std::vector<Error> check_edge(const Scenario& scenario, const GivenValues& given);

/// `offload.plan` and so on; none without an edge computer.
[[nodiscard]] std::vector<KnobSpec> offload_knobs(const Scenario& scenario);

/// The edge computer of the scenario; empty when there is none.
///
/// @error That of `load_platform`.
[[nodiscard]] Result<std::optional<EdgeModel>> make_edge(const Scenario& scenario);

}  // namespace flyball
