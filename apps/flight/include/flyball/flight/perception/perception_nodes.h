// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From camera to map, as in MAVBench's dataflows: localization, point cloud, occupancy map.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/perception/localization_nodes.h"
#include "flyball/flight/perception/map_hints.h"
#include "flyball/flight/perception/map_revision.h"

namespace flyball {

/// Pose of the first depth camera; its mount compensates the body's roll and pitch.
[[nodiscard]] Pose camera_pose(const Pose& X_WB, const DepthCameraSpec& camera);

struct PerceptionTopics {
  LocalizationTopics localization;
  Topic<PointCloudFrame> cloud;
  Topic<MapHint> map_hints;  ///< A queue.
  Topic<MapRevision> map;
};

/// Adds the nodes of the localization, `slam_load` (if the settings ask for it), `points` and
/// `map`; `camera` before them, if its rate is a knob.
[[nodiscard]] PerceptionTopics add_perception(Graph& graph, const FlightParts& parts);

}  // namespace flyball
