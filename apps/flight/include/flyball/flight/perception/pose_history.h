// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The poses of the last seconds, to look up where the camera was when it captured a frame.

#include "flyball/runtime/graph.h"
#include "flyball/runtime/messages.h"

#include <deque>
#include <optional>

namespace flyball {

/// An older pose says nothing of now. Chosen: the fastest turn is 22 degrees in it.
inline constexpr Duration longest_pose_age = std::chrono::milliseconds{250};

class PoseHistory {
 public:
  void add(const PoseEstimate& pose);
  /// Takes all that the queue holds.
  void take_from(JobContext& job, Topic<PoseEstimate> poses);
  /// Interpolated pose at a time. Null when there is none within `longest_pose_age`.
  [[nodiscard]] std::optional<PoseEstimate> at(MissionTime t) const;

 private:
  std::deque<PoseEstimate> poses_;
};

}  // namespace flyball
