// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The node `follow`, which owns the navigator and computes the set-points.

#include "flyball/flight/navigation/navigation_nodes.h"

#include <memory>
#include <optional>

namespace flyball {

/// What the node is made of.
struct FollowNode {
  FlightParts parts;
  LocalizationTopics localization;
  NavigationTopics topics;
  std::optional<Topic<MapHint>> map_hints{};        ///< Where there is a map to be told.
  std::shared_ptr<const OccupancyView> declared{};  ///< Where there is none. Owners: the nodes.
};

/// Adds the node. It runs at 50 Hz, never waits for map or planner, and takes what they say when it
/// is there.
void add_follow(Graph& graph, const FollowNode& node);

}  // namespace flyball
