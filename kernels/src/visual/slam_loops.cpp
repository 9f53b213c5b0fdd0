// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_slam
//
// Back where it was before: the keyframes of then bind those of now.

#include "visual/motion.h"
#include "visual/slam.h"
#include <algorithm>

namespace flyball {
namespace {

constexpr std::size_t least_age = 20;    // Keyframes between then and now.
constexpr std::size_t rest_after = 10;   // Keyframes between two loops.
constexpr double first_reach_m = 2.0;    // How far the estimate may be off: this, and
constexpr double reach_share = 0.05;     // so much of the path in between.
constexpr double widest_turn_rad = 0.8;  // ORB recognises no view that is turned further.
constexpr std::size_t most_candidates = 2;
constexpr int inlier_factor = 2;  // A wrong loop bends the whole map: twice a pose's.

}  // namespace

std::vector<std::size_t> Slam::loop_candidates() const {
  const std::vector<Keyframe>& all = map_.keyframes();
  const Keyframe& now = all.back();
  const std::vector<std::size_t> local = map_.neighbours(all.size() - 1, local_keyframes);
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i + least_age < all.size(); ++i) {
    const Pose step = all[i].X_WC.inverse() * now.X_WC;
    const double away_m = step.translation().norm();
    const double reach_m = first_reach_m + reach_share * (now.path_m - all[i].path_m);
    const bool is_local = std::find(local.begin(), local.end(), i) != local.end();
    if (!is_local && away_m < reach_m && rotation_vector(step.linear()).norm() < widest_turn_rad) {
      near.emplace_back(away_m, i);
    }
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min(near.size(), most_candidates));
  std::vector<std::size_t> candidates;
  candidates.reserve(near.size());
  for (const auto& [away_m, keyframe] : near) {
    candidates.push_back(keyframe);
  }
  return candidates;
}

bool Slam::close_loop(const CameraModel& camera, Work& work) {
  const std::size_t now = map_.keyframes().size() - 1;
  if (last_loop_ > 0 && now < last_loop_ + rest_after) {
    return false;
  }
  const FeatureGrid grid{map_.keyframes()[now].features, camera};
  for (const std::size_t old : loop_candidates()) {
    const auto matches = match_by_look(map_, old, grid.features(), work);
    const auto found = solve(matches, grid, camera, work);
    if (found && found->pose.inliers >= inlier_factor * settings_.least_inliers) {
      return bind(old, *found, work);
    }
  }
  return false;
}

/// Where the old landmarks say that the newest keyframe is, it goes; those in between share the
/// correction. The old landmarks become part of the local map.
bool Slam::bind(std::size_t old, const Found& found, Work& work) {
  const std::size_t now = map_.keyframes().size() - 1;
  const Pose step = map_.keyframes()[old].X_WC.inverse() * found.pose.X_WC;
  edges_.push_back({old, now, step, 0.02, 0.002});
  const Matrix6 covariance = uncertainty(found);
  std::vector<Pose> poses;
  for (const Keyframe& keyframe : map_.keyframes()) {
    poses.push_back(keyframe.X_WC);
  }
  const Result<std::vector<Pose>> adjusted = adjust(poses, edges_, work);
  if (!adjusted) {
    edges_.pop_back();
    return false;
  }
  const Pose X_KC = map_.keyframes()[now].X_WC.inverse() * X_WC_;
  map_.move(*adjusted);
  map_.bind(old, now, covariance);
  X_WC_ = map_.keyframes()[now].X_WC * X_KC;
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    if (found.pose.fits[i]) {
      map_.merge(now, found.matches[i].feature, found.matches[i].landmark);
    }
  }
  last_loop_ = now;
  return true;
}

}  // namespace flyball
