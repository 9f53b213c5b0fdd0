// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A localizer that sees, in the graph.

#include "flyball/flight/mission_context.h"

namespace flyball {

/// Adds the topics `view` and `fix`, the node `see`, which works on frames and takes its time, and
/// the node `correct`, which hands its result to the localizer. Nothing for one that is blind.
void add_sight(Graph& graph, MissionContext& context);

}  // namespace flyball
