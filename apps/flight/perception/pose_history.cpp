// SPDX-License-Identifier: BSD-3-Clause
// tested-in: perception_nodes
#include "flyball/flight/perception/pose_history.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto pose_memory = 3s;  // Chosen: a frame waits less for its mapping to begin.

}  // namespace

void PoseHistory::add(const PoseEstimate& pose) {
  if (!poses_.empty() && pose.stamp < poses_.back().stamp) {
    poses_.clear();  // The clock that stamps them was set back.
  }
  if (!poses_.empty() && pose.stamp == poses_.back().stamp) {
    poses_.pop_back();  // An estimate that grows old.
  }
  poses_.push_back(pose);
  while (poses_.front().stamp + pose_memory < pose.stamp) {
    poses_.pop_front();
  }
}

void PoseHistory::take_from(JobContext& job, Topic<PoseEstimate> poses) {
  while (const auto pose = job.take(poses)) {
    add(*pose);
  }
}

std::optional<PoseEstimate> PoseHistory::at(MissionTime t) const {
  if (poses_.empty()) {
    return std::nullopt;
  }
  const auto after = std::lower_bound(
      poses_.begin(), poses_.end(), t,
      [](const PoseEstimate& pose, MissionTime time) { return pose.stamp < time; });
  if (after == poses_.end()) {
    return t - poses_.back().stamp <= longest_pose_age ? std::optional{poses_.back()}
                                                       : std::nullopt;
  }
  if (after == poses_.begin() || after->stamp == t) {
    return after->stamp - t <= longest_pose_age ? std::optional{*after} : std::nullopt;
  }
  const PoseEstimate& a = *(after - 1);
  const PoseEstimate& b = *after;
  if (b.stamp - a.stamp > longest_pose_age) {
    return std::nullopt;
  }
  const double u = ratio(t - a.stamp, b.stamp - a.stamp);
  PoseEstimate mixed = a;
  mixed.stamp = t;
  mixed.X_WB.translation() = (1.0 - u) * a.X_WB.translation() + u * b.X_WB.translation();
  mixed.X_WB.linear() = Eigen::Quaterniond{a.X_WB.linear()}
                            .slerp(u, Eigen::Quaterniond{b.X_WB.linear()})
                            .toRotationMatrix();
  mixed.v_WB = (1.0 - u) * a.v_WB + u * b.v_WB;
  return mixed;
}

}  // namespace flyball
