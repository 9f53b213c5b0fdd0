// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Camera poses and a map of landmarks from a sequence of RGB-D frames.

#include "visual/matcher.h"
#include "visual/motion.h"
#include "visual/pose_graph.h"

namespace flyball {

struct SlamSettings {
  FeatureSettings features{};
  int least_inliers{15};  ///< Fewer agreeing landmarks are no pose.
};

struct SlamOutcome {
  bool tracked{};
  Pose X_WC{Pose::Identity()};          ///< The last known one when not tracked.
  Matrix6 covariance{Matrix6::Zero()};  ///< Of (p, r) in C, since the start.
  int matches{};
  int inliers{};
  bool new_keyframe{};
  bool loop_closed{};
};

/// The parts and their order are ORB-SLAM2's for RGB-D (Mur-Artal & Tardos 2017,
/// doi:10.1109/TRO.2017.2705103): predict, look for the local map's landmarks, pose, keyframe,
/// loop. In place of bundle adjustment each landmark is a Kalman filter of its place, and the pose
/// weighs landmarks by their uncertainty, on places that are followed from the reference keyframe
/// to a fraction of a pixel. In place of a bag of words, keyframes near the pose are compared.
class Slam {
 public:
  explicit Slam(const SlamSettings& settings);

  /// Forgets everything; the next frame is seen from here.
  void start(const Pose& X_WC);
  /// Frames in order of time. While the track is lost, each frame is compared with a few keyframes.
  /// Adds `pixels`, `features`, `matches`, `patches`, `ransac_iterations` and `graph_edges` to
  /// `work`.
  /// @error As `FeatureExtractor::extract`; the map is unchanged.
  [[nodiscard]] Result<SlamOutcome> track(const VisualFrame& frame, Work& work);
  [[nodiscard]] const LandmarkMap& map() const { return map_; }

 private:
  struct Found {
    SolvedPose pose{};
    std::vector<Match> matches{};  ///< As many as `pose.fits`.
  };

  [[nodiscard]] SlamOutcome begin(const VisualFrame& frame, std::vector<Feature> features);
  void go_to(const Pose& X_WC, MissionTime now);
  [[nodiscard]] Pose predicted(MissionTime now) const;
  [[nodiscard]] std::optional<Found> follow(const VisualFrame& frame,
                                            const FeatureGrid& grid,
                                            Work& work);
  [[nodiscard]] std::optional<Found> relocalize(const VisualFrame& frame,
                                                const FeatureGrid& grid,
                                                Work& work);
  [[nodiscard]] std::optional<Found> solve(const std::vector<Match>& matches,
                                           const FeatureGrid& grid,
                                           const CameraModel& camera,
                                           Work& work) const;
  [[nodiscard]] Found extend(Found found,
                             const VisualFrame& frame,
                             const FeatureGrid& grid,
                             Work& work);
  [[nodiscard]] Found sharpen(Found found,
                              const VisualFrame& frame,
                              std::vector<Feature>& features,
                              Work& work) const;
  void learn(const Found& found, const std::vector<Feature>& features, const CameraModel& camera);
  /// Of a pose that has been found: that of its landmarks' keyframes, and its own.
  [[nodiscard]] Matrix6 uncertainty(const Found& found) const;
  [[nodiscard]] bool wants_keyframe(const Found& found) const;
  [[nodiscard]] SolvedPose refined(const std::vector<Match>& matches,
                                   const std::vector<Feature>& features,
                                   const CameraModel& camera,
                                   const Pose& X_WC_guess) const;
  void add_keyframe(const Found& found, const VisualFrame& frame, std::vector<Feature> features);
  bool close_loop(const CameraModel& camera, Work& work);
  [[nodiscard]] std::vector<std::size_t> loop_candidates() const;
  bool bind(std::size_t old, const Found& found, Work& work);

  SlamSettings settings_;
  FeatureExtractor extractor_;
  LandmarkMap map_;
  std::vector<PoseEdge> edges_;
  Pose X_WC_{Pose::Identity()};   ///< Newest.
  MissionTime captured_{};        ///< Of the newest pose.
  std::optional<Vec6> speed_{};   ///< Of C, in C: shift and rotation a second.
  std::size_t reference_{};       ///< Keyframe that the newest frame resembles.
  int reference_inliers_{};       ///< The most since it was made.
  std::size_t next_candidate_{};  ///< Where relocalisation goes on.
  std::size_t last_loop_{};       ///< Keyframe that closed it.
  bool lost_{};
};

}  // namespace flyball
