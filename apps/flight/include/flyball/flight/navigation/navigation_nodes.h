// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From map to set-point: collision check, path planning, smoothing, path tracking.

#include "flyball/flight/navigation/navigator.h"
#include "flyball/flight/perception/perception_nodes.h"

namespace flyball {

struct NavigationTopics {
  Service<PlanQuery, PlanAnswer> plan;
  Topic<PlannedPath> path;
};

/// Adds the nodes `smooth` and `follow`, and the service `plan` between them. The caller adds the
/// node that answers it.
/// @param navigator  Outlives the graph's jobs.
NavigationTopics add_path_following(Graph& graph,
                                    const VehicleTopics& vehicle,
                                    Topic<PoseEstimate> pose,
                                    MissionContext& context,
                                    Navigator& navigator);

/// Adds the nodes `check`, `plan`, `smooth` and `follow`.
/// @param navigator  Outlives the graph's jobs.
NavigationTopics add_navigation(Graph& graph,
                                const VehicleTopics& vehicle,
                                const PerceptionTopics& perception,
                                MissionContext& context,
                                Navigator& navigator);

}  // namespace flyball
