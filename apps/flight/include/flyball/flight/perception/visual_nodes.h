// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A localizer that uses camera images, as nodes of the graph.

#include "flyball/flight/mission_context.h"

namespace flyball {

/// Adds the topics `view` and `fix`, the node `see`, which processes frames and takes time for it,
/// and the node `correct`, which hands the result to the localizer. Adds nothing for a localizer
/// that uses no images.
void add_sight(Graph& graph, MissionContext& context);

}  // namespace flyball
