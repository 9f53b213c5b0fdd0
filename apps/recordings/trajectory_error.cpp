// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/trajectory_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr Duration widest_match = 20ms;  // TUM's evaluate_ate.py: --max_difference 0.02.

/// @pre `truth` is in order of time and not empty.
const TimedPose& nearest(const std::vector<TimedPose>& truth, MissionTime t) {
  const auto after =
      std::lower_bound(truth.begin(), truth.end(), t,
                       [](const TimedPose& pose, MissionTime time) { return pose.stamp < time; });
  if (after == truth.begin()) {
    return *after;
  }
  const auto before = after - 1;
  return after == truth.end() || t - before->stamp < after->stamp - t ? *before : *after;
}

}  // namespace

std::optional<TrajectoryError> absolute_trajectory_error(const std::vector<TimedPose>& estimate,
                                                         const std::vector<TimedPose>& truth) {
  std::vector<std::pair<Vec3, Vec3>> pairs;  // Estimated, true.
  for (const TimedPose& pose : estimate) {
    if (!truth.empty()) {
      const TimedPose& real = nearest(truth, pose.stamp);
      if (std::chrono::abs(real.stamp - pose.stamp) <= widest_match) {
        pairs.emplace_back(pose.X_WB.translation(), real.X_WB.translation());
      }
    }
  }
  if (pairs.size() < 3) {
    return std::nullopt;
  }
  Eigen::Matrix3Xd from(3, pairs.size());
  Eigen::Matrix3Xd to(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = pairs[i].first;
    to.col(static_cast<Eigen::Index>(i)) = pairs[i].second;
  }
  const Eigen::Matrix4d X = Eigen::umeyama(from, to, false);
  TrajectoryError error;
  std::vector<double> misses_m;
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    const Vec3 moved = X.topLeftCorner<3, 3>() * from.col(i) + X.topRightCorner<3, 1>();
    misses_m.push_back((moved - to.col(i)).norm());
    error.rmse_m += misses_m.back() * misses_m.back();
    error.mean_m += misses_m.back();
    error.path_m += i > 0 ? (to.col(i) - to.col(i - 1)).norm() : 0.0;
  }
  const auto count = static_cast<double>(misses_m.size());
  error.pairs = static_cast<int>(misses_m.size());
  error.rmse_m = std::sqrt(error.rmse_m / count);
  error.mean_m /= count;
  std::sort(misses_m.begin(), misses_m.end());
  error.median_m = misses_m[misses_m.size() / 2];
  error.max_m = misses_m.back();
  return error;
}

}  // namespace flyball
