// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From map to set-point: collision check, path planning, smoothing, path tracking.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/navigation/guidance.h"
#include "flyball/flight/navigation/path_clearance.h"
#include "flyball/flight/navigation/plan_service.h"
#include "flyball/flight/perception/perception_nodes.h"

#include <memory>
#include <optional>

namespace flyball {

struct NavigationTopics {
  GuidanceTopics guidance;
  Service<PlanQuery, PlanAnswer> plan;
  Topic<PlannedPath> path;
  std::optional<Topic<PathClearance>> clearance{};  ///< Where there is a map.
  Topic<MapUse> map_use;  ///< One for each map that a set-point was computed with.
};

/// Adds the nodes `smooth` and `follow`, and the service `plan` between them, for a flight without
/// a map. The caller adds the node that answers the service.
/// @param declared  The space that is declared free. Owners: the nodes.
[[nodiscard]] NavigationTopics add_path_following(Graph& graph,
                                                  const FlightParts& parts,
                                                  const LocalizationTopics& localization,
                                                  std::shared_ptr<const OccupancyView> declared);

/// Adds the nodes `check`, `plan`, `smooth` and `follow`. The navigator belongs to `follow`.
[[nodiscard]] NavigationTopics add_navigation(Graph& graph,
                                              const FlightParts& parts,
                                              const PerceptionTopics& perception);

}  // namespace flyball
