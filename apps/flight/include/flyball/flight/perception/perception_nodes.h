// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// From camera to map, as in the paper's dataflows: localization, point cloud, OctoMap.

#include "flyball/flight/mission_context.h"

#include <deque>

namespace flyball {

/// Poses of the last seconds, to look up where the camera was when it saw a frame.
class PoseHistory {
 public:
  void add(const PoseEstimate& pose);
  /// Interpolated; the nearest end outside of what is kept. Null when empty.
  [[nodiscard]] std::optional<PoseEstimate> at(MissionTime t) const;

 private:
  std::deque<PoseEstimate> poses_;
};

/// The first camera of the scenario; its mount takes out the body's roll and pitch.
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

/// Adds the nodes `localize`, `slam_load` (if the scenario wants it), `points` and `map`.
PerceptionTopics add_perception(Graph& graph,
                                const VehicleTopics& vehicle,
                                MissionContext& context);

}  // namespace flyball
