// SPDX-License-Identifier: BSD-3-Clause
// tested-in: referee
#include "simulation/judging/localization_judge.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto memory = 5s;  // Chosen: estimates are some milliseconds old, even on slow computers.

}  // namespace

LocalizationJudge::LocalizationJudge(Executor& executor, Topic<PoseEstimate> pose) {
  executor.subscribe<PoseEstimate>(pose,
                                   [this](const PoseEstimate& estimate) { compare(estimate); });
}

void LocalizationJudge::note(const TruePose& pose) {
  poses_.push_back(pose);
  while (poses_.front().stamp + memory < pose.stamp) {
    poses_.pop_front();
  }
}

void LocalizationJudge::compare(const PoseEstimate& estimate) {
  const auto truth =
      std::lower_bound(poses_.begin(), poses_.end(), estimate.stamp,
                       [](const TruePose& pose, MissionTime t) { return pose.stamp < t; });
  if (truth == poses_.end() || truth->stamp != estimate.stamp) {
    return;
  }
  const double error_m = (estimate.X_WB.translation() - truth->X_WB.translation()).norm();
  error_sum_m_ += error_m;
  error_max_m_ = std::max(error_max_m_, error_m);
  ++compared_;
}

std::map<std::string, double> LocalizationJudge::figures() const {
  if (compared_ == 0) {
    return {};
  }
  return {{"localization_error_m_mean", error_sum_m_ / static_cast<double>(compared_)},
          {"localization_error_m_max", error_max_m_}};
}

}  // namespace flyball
