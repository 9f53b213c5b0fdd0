// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Points of the world that were seen, and the frames that saw them.

#include "visual/feature.h"
#include "visual/pose_solver.h"
#include <vector>

namespace flyball {

/// Kept relative to the keyframe that saw it first, so that it moves with it.
struct Landmark {
  std::size_t anchor{};
  Vec3 p_K{Vec3::Zero()};
  Eigen::Matrix3d covariance_K{Eigen::Matrix3d::Zero()};
  Descriptor descriptor{};
  int octave{};                        ///< In the anchor's image.
  double distance_m{};                 ///< From the anchor.
  int expected{1};                     ///< Frames in whose view it should have been.
  int found{1};                        ///< Frames in which it was recognised.
  std::vector<std::size_t> seen_by{};  ///< Keyframes.
};

constexpr int no_landmark = -1;
/// Keyframes whose landmarks a frame is compared with.
constexpr std::size_t local_keyframes = 10;

struct Keyframe {
  MissionTime captured{};
  Pose X_WC{Pose::Identity()};
  Matrix6 covariance{Matrix6::Zero()};  ///< Of (p, r) in C, since the first keyframe.
  double path_m{};                      ///< Flown since the first one.
  std::vector<Feature> features{};
  std::vector<int> landmarks{};      ///< Of each feature, or `no_landmark`.
  std::vector<std::uint8_t> grey{};  ///< The image.
};

/// Only grows, but for `merge`.
class LandmarkMap {
 public:
  /// Features with depth and without a landmark become landmarks.
  std::size_t add(Keyframe keyframe, const CameraModel& camera);
  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  [[nodiscard]] const Landmark& landmark(int id) const {
    return landmarks_[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] Vec3 p_W(int id) const;
  [[nodiscard]] Eigen::Matrix3d covariance_W(int id) const;
  /// A landmark seen again: its place becomes more certain (Kalman update, the camera's pose taken
  /// as known to 1 cm).
  void observe(int id, const Feature& feature, const CameraModel& camera, const Pose& X_WC);
  void count_expected(int id) { ++landmarks_[static_cast<std::size_t>(id)].expected; }
  /// Whether it is found so seldom that it is no good.
  [[nodiscard]] bool is_doubtful(int id) const;
  /// The keyframes that share most landmarks with this one, itself first; at most `count`.
  [[nodiscard]] std::vector<std::size_t> neighbours(std::size_t keyframe, std::size_t count) const;
  /// What those keyframes see, each landmark once, doubtful ones left out.
  [[nodiscard]] std::vector<int> landmarks_of(const std::vector<std::size_t>& keyframes) const;
  void move(const std::vector<Pose>& X_WC);
  /// A loop between keyframes `old` and `now` leaves `now` with this covariance; those in between
  /// share what that takes off by their part of the path.
  void bind(std::size_t old, std::size_t now, const Matrix6& covariance);
  /// Feature `feature` of a keyframe turns out to be the older landmark `id`.
  void merge(std::size_t keyframe, std::size_t feature, int id);

 private:
  int add_landmark(const Feature& feature, std::size_t keyframe, const CameraModel& camera);

  std::vector<Keyframe> keyframes_;
  std::vector<Landmark> landmarks_;
};

/// What the pose solver needs to know of a feature that is a landmark.
[[nodiscard]] LandmarkSighting sighting_of(const LandmarkMap& map,
                                           int landmark,
                                           const Feature& feature);

}  // namespace flyball
