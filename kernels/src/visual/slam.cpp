// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_slam
#include "visual/slam.h"

#include "visual/motion.h"
#include "visual/patches.h"
#include "visual/undistortion.h"
#include <algorithm>
#include <cmath>
#include <map>

namespace flyball {
namespace {

// Search radius as a share of the image's width: 13 px at 320, as wide as ORB-SLAM's 15 px at 640
// is when it looks again. Motion that the prediction misses by more is lost.
constexpr double search_share = 0.04;
constexpr double extend_share = 0.015;  // Once the pose is known.

// A new keyframe when fewer than this share of the reference's landmarks are found, or the view
// changed so much that the map is seen from elsewhere.
constexpr double keyframe_inlier_share = 0.6;
constexpr double keyframe_turn_rad = 0.25;
constexpr double keyframe_shift_share = 0.1;  // Of the median distance of what is seen.

std::vector<int> no_landmarks(std::size_t features) {
  return std::vector<int>(features, no_landmark);
}

/// Where a camera without distortion sees a feature that turns out to be elsewhere in the image.
Eigen::Vector2d straight_place(const Feature& feature,
                               const Eigen::Vector2d& raw_pixel,
                               const CameraModel& camera) {
  if (is_distorted(camera)) {
    if (const auto straight = straightened(camera, {raw_pixel.cast<float>()}).front()) {
      return straight->cast<double>();
    }
  }
  return feature.pixel + (raw_pixel - feature.raw_pixel);
}

}  // namespace

Slam::Slam(const SlamSettings& settings) : settings_{settings}, extractor_{settings.features} {}

void Slam::start(const Pose& X_WC) {
  map_ = {};
  edges_.clear();
  X_WC_ = X_WC;
  speed_ = std::nullopt;
  reference_ = next_candidate_ = last_loop_ = 0;
  lost_ = false;
}

Result<SlamOutcome> Slam::track(const VisualFrame& frame, Work& work) {
  Result<std::vector<Feature>> features = extractor_.extract(frame, work);
  if (!features) {
    return features.error();
  }
  if (map_.keyframes().empty()) {
    return begin(frame, std::move(*features));
  }
  if (const std::size_t before = map_.keyframes().front().grey.size();
      frame.grey.size() != before) {
    return Error{ErrorCode::invalid_input,
                 "a frame of " + std::to_string(frame.grey.size()) + " pixels follows frames of " +
                     std::to_string(before) + "; one localizer takes the images of one camera"};
  }
  SlamOutcome outcome;
  const FeatureGrid grid{*features, frame.camera};
  std::optional<Found> found = lost_ ? relocalize(frame, grid, work) : follow(frame, grid, work);
  lost_ = !found;
  outcome.X_WC = X_WC_;
  if (!found) {
    speed_ = std::nullopt;
    return outcome;
  }
  Found all = extend(std::move(*found), frame, grid, work);
  all = sharpen(std::move(all), frame, *features, work);
  learn(all, *features, frame.camera);
  go_to(all.pose.X_WC, frame.captured);
  outcome.tracked = true;
  outcome.covariance = uncertainty(all);
  outcome.matches = static_cast<int>(all.matches.size());
  outcome.inliers = all.pose.inliers;
  reference_inliers_ = std::max(reference_inliers_, all.pose.inliers);
  if (wants_keyframe(all)) {
    outcome.new_keyframe = true;
    add_keyframe(all, frame, std::move(*features));
    outcome.loop_closed = close_loop(frame.camera, work);
    outcome.covariance = map_.keyframes().back().covariance;
  }
  outcome.X_WC = X_WC_;
  return outcome;
}

/// The first frame that shows enough is the first keyframe.
SlamOutcome Slam::begin(const VisualFrame& frame, std::vector<Feature> features) {
  const auto with_depth = std::count_if(features.begin(), features.end(),
                                        [](const Feature& f) { return f.depth_m.has_value(); });
  SlamOutcome outcome;
  outcome.X_WC = X_WC_;
  outcome.tracked = outcome.new_keyframe = with_depth >= 2L * settings_.least_inliers;
  if (outcome.tracked) {
    Found nothing;
    nothing.pose.X_WC = X_WC_;
    captured_ = frame.captured;
    add_keyframe(nothing, frame, std::move(features));
  }
  return outcome;
}

void Slam::go_to(const Pose& X_WC, MissionTime now) {
  const double dt_s = to_seconds(now - captured_);
  if (dt_s > 0.0) {
    const Pose step = X_WC_.inverse() * X_WC;
    Vec6 speed;
    speed << step.translation(), rotation_vector(step.linear());
    speed_ = speed / dt_s;
  }
  X_WC_ = X_WC;
  captured_ = now;
}

Pose Slam::predicted(MissionTime now) const {
  return speed_ ? moved(X_WC_, *speed_ * to_seconds(now - captured_)) : X_WC_;
}

std::optional<Slam::Found> Slam::solve(const std::vector<Match>& matches,
                                       const FeatureGrid& grid,
                                       const CameraModel& camera,
                                       Work& work) const {
  std::vector<LandmarkSighting> sightings;
  sightings.reserve(matches.size());
  for (const Match& match : matches) {
    sightings.push_back(sighting_of(map_, match.landmark, grid.features()[match.feature]));
  }
  auto solved = solve_pose(sightings, camera, settings_.least_inliers, work);
  if (!solved) {
    return std::nullopt;
  }
  return Found{std::move(*solved), matches};
}

std::optional<Slam::Found> Slam::follow(const VisualFrame& frame,
                                        const FeatureGrid& grid,
                                        Work& work) {
  const std::vector<int> local = map_.landmarks_of(map_.neighbours(reference_, local_keyframes));
  LandmarkSearch view{frame.camera, predicted(frame.captured), search_share * frame.camera.width_px,
                      nullptr};
  if (auto found = solve(match_by_place(map_, local, grid, view, work), grid, frame.camera, work)) {
    return found;
  }
  view.X_WC = X_WC_;  // It may have stopped, or braked.
  view.radius_px *= 2.0;
  if (auto found = solve(match_by_place(map_, local, grid, view, work), grid, frame.camera, work)) {
    return found;
  }
  return solve(match_by_look(map_, reference_, grid.features(), work), grid, frame.camera, work);
}

std::optional<Slam::Found> Slam::relocalize(const VisualFrame& frame,
                                            const FeatureGrid& grid,
                                            Work& work) {
  // Those nearest to where it was lost, and a few more of all the others each time.
  std::vector<std::size_t> order = map_.neighbours(reference_, 3);
  constexpr std::size_t more = 3;
  for (std::size_t i = 0; i < std::min(more, map_.keyframes().size()); ++i) {
    order.push_back(next_candidate_ % map_.keyframes().size());
    next_candidate_ = (next_candidate_ + 1) % map_.keyframes().size();
  }
  for (const std::size_t keyframe : order) {
    const auto matches = match_by_look(map_, keyframe, grid.features(), work);
    if (auto found = solve(matches, grid, frame.camera, work)) {
      reference_ = keyframe;
      return found;
    }
  }
  return std::nullopt;
}

/// With the pose known, the rest of the local map is looked for close to where it must be.
Slam::Found Slam::extend(Found found,
                         const VisualFrame& frame,
                         const FeatureGrid& grid,
                         Work& work) {
  const std::vector<int> local = map_.landmarks_of(map_.neighbours(reference_, local_keyframes));
  std::vector<int> in_view;
  const LandmarkSearch view{frame.camera, found.pose.X_WC, extend_share * frame.camera.width_px,
                            &in_view};
  const auto matches = match_by_place(map_, local, grid, view, work);
  for (const int id : in_view) {
    map_.count_expected(id);
  }
  SolvedPose solved = refined(matches, grid.features(), frame.camera, found.pose.X_WC);
  if (solved.inliers < found.pose.inliers) {
    return found;
  }
  return {std::move(solved), matches};
}

SolvedPose Slam::refined(const std::vector<Match>& matches,
                         const std::vector<Feature>& features,
                         const CameraModel& camera,
                         const Pose& X_WC_guess) const {
  std::vector<LandmarkSighting> sightings;
  sightings.reserve(matches.size());
  for (const Match& match : matches) {
    sightings.push_back(sighting_of(map_, match.landmark, features[match.feature]));
  }
  return refine(sightings, camera, X_WC_guess);
}

/// What the reference keyframe sees too is followed from there to a fraction of a pixel; then the
/// pose again.
Slam::Found Slam::sharpen(Found found,
                          const VisualFrame& frame,
                          std::vector<Feature>& features,
                          Work& work) const {
  const Keyframe& reference = map_.keyframes()[reference_];
  std::map<int, std::size_t> seen;
  for (std::size_t i = 0; i < reference.landmarks.size(); ++i) {
    seen.emplace(reference.landmarks[i], i);
  }
  std::vector<PatchPair> pairs;
  std::vector<std::size_t> followed;
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    const auto before = seen.find(found.matches[i].landmark);
    if (found.pose.fits[i] && before != seen.end()) {
      pairs.push_back({reference.features[before->second].raw_pixel,
                       features[found.matches[i].feature].raw_pixel});
      followed.push_back(found.matches[i].feature);
    }
  }
  const auto places = follow_patches(reference.grey, frame.grey, frame.camera, pairs);
  work.add("patches", static_cast<double>(pairs.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i]) {
      Feature& feature = features[followed[i]];
      feature.pixel = straight_place(feature, *places[i], frame.camera);
      feature.raw_pixel = *places[i];
      feature.sigma_px = patch_sigma_px;
      measure_depth(feature, frame);
    }
  }
  found.pose = refined(found.matches, features, frame.camera, found.pose.X_WC);
  return found;
}

void Slam::learn(const Found& found,
                 const std::vector<Feature>& features,
                 const CameraModel& camera) {
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    if (found.pose.fits[i]) {
      const Match& match = found.matches[i];
      map_.observe(match.landmark, features[match.feature], camera, found.pose.X_WC);
    }
  }
}

bool Slam::wants_keyframe(const Found& found) const {
  const Keyframe& reference = map_.keyframes()[reference_];
  const Pose step = reference.X_WC.inverse() * found.pose.X_WC;
  std::vector<double> distances_m;
  for (const Match& match : found.matches) {
    distances_m.push_back((map_.p_W(match.landmark) - found.pose.X_WC.translation()).norm());
  }
  const auto middle = distances_m.begin() + static_cast<std::ptrdiff_t>(distances_m.size() / 2);
  std::nth_element(distances_m.begin(), middle, distances_m.end());
  return found.pose.inliers < keyframe_inlier_share * reference_inliers_ ||
         rotation_vector(step.linear()).norm() > keyframe_turn_rad ||
         step.translation().norm() > keyframe_shift_share * *middle;
}

void Slam::add_keyframe(const Found& found,
                        const VisualFrame& frame,
                        std::vector<Feature> features) {
  Keyframe fresh;
  fresh.captured = frame.captured;
  fresh.X_WC = found.pose.X_WC;
  fresh.covariance = uncertainty(found);
  fresh.grey = frame.grey;
  fresh.landmarks = no_landmarks(features.size());
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    if (found.pose.fits[i]) {
      fresh.landmarks[found.matches[i].feature] = found.matches[i].landmark;
    }
  }
  fresh.features = std::move(features);
  if (!map_.keyframes().empty()) {
    const Keyframe& before = map_.keyframes()[reference_];
    const Pose step = before.X_WC.inverse() * fresh.X_WC;
    fresh.path_m = before.path_m + step.translation().norm();
    // Drift of one step, as measured on rendered views: about 1 % and a few mm, .1 degrees.
    edges_.push_back({reference_, map_.keyframes().size(), step,
                      0.005 + 0.01 * step.translation().norm(), 0.002});
  }
  reference_ = map_.add(std::move(fresh), frame.camera);
  reference_inliers_ = 0;
}

}  // namespace flyball
