// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From camera to map, as in MAVBench's dataflows: localization, point cloud, occupancy map.

#include "flyball/flight/mission_context.h"

#include <deque>

namespace flyball {

/// The poses of the last seconds, to look up where the camera was when it captured a frame.
class PoseHistory {
 public:
  void add(const PoseEstimate& pose);
  /// Interpolated pose at a time; outside the kept range the nearest end. Null when there is none.
  [[nodiscard]] std::optional<PoseEstimate> at(MissionTime t) const;

 private:
  std::deque<PoseEstimate> poses_;
};

/// Pose of the first depth camera; its mount compensates the body's roll and pitch.
[[nodiscard]] Pose camera_pose(const Pose& X_WB, const DepthCameraSpec& camera);

struct PerceptionTopics {
  Topic<PoseEstimate> pose;
  Topic<PointCloudFrame> cloud;
  Topic<MapRevision> map;
};

/// Adds the node `localize`: navigation samples to poses.
Topic<PoseEstimate> add_localization(Graph& graph,
                                     const VehicleTopics& vehicle,
                                     MissionContext& context);

/// Adds the nodes `localize`, `slam_load` (if the settings ask for it), `points` and `map`.
PerceptionTopics add_perception(Graph& graph,
                                const VehicleTopics& vehicle,
                                MissionContext& context);

}  // namespace flyball
