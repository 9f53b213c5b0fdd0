// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The poses of the last seconds, to look up where the camera was when it captured a frame.

#include "flyball/runtime/graph.h"
#include "flyball/runtime/messages.h"

#include <deque>
#include <optional>

namespace flyball {

class PoseHistory {
 public:
  void add(const PoseEstimate& pose);
  /// Takes all that the queue holds.
  void take_from(JobContext& job, Topic<PoseEstimate> poses);
  /// Interpolated pose at a time. Null when there is none within a quarter of a second.
  [[nodiscard]] std::optional<PoseEstimate> at(MissionTime t) const;

 private:
  std::deque<PoseEstimate> poses_;
};

}  // namespace flyball
