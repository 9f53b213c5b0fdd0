// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_slam
#include "visual/landmark_map.h"

#include "visual/patches.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double pose_sigma_m = 0.01;

/// Uncertainty of a point from one view: across the ray by the pixel, along it by the depth `d`.
Eigen::Matrix3d covariance_C(const Feature& feature,
                             const CameraModel& camera,
                             double d,
                             double sigma_px) {
  const Vec3 ray = back_projected(camera, feature.pixel, 1.0);
  const double across_m = d * sigma_px / camera.focal_x_px;
  const double along_m = std::hypot(depth_sigma_m(d), feature.slope_m_px * sigma_px);
  Eigen::Matrix3d covariance = along_m * along_m * ray * ray.transpose();
  covariance.diagonal().array() += across_m * across_m;
  return covariance;
}

}  // namespace

LandmarkSighting sighting_of(const LandmarkMap& map, int landmark, const Feature& feature) {
  return {map.p_W(landmark), map.covariance_W(landmark),           feature.pixel, feature.sigma_px,
          feature.depth_m,   feature.slope_m_px * feature.sigma_px};
}

std::size_t LandmarkMap::add(Keyframe keyframe, const CameraModel& camera) {
  const std::size_t number = keyframes_.size();
  for (std::size_t i = 0; i < keyframe.features.size(); ++i) {
    int& id = keyframe.landmarks[i];
    if (id == no_landmark && keyframe.features[i].depth_m) {
      id = add_landmark(keyframe.features[i], number, camera);
    }
    if (id != no_landmark) {
      landmarks_[static_cast<std::size_t>(id)].seen_by.push_back(number);
    }
  }
  keyframes_.push_back(std::move(keyframe));
  return number;
}

int LandmarkMap::add_landmark(const Feature& feature,
                              std::size_t keyframe,
                              const CameraModel& camera) {
  Landmark fresh;
  fresh.anchor = keyframe;
  fresh.p_K = back_projected(camera, feature.pixel, *feature.depth_m);
  // It is whatever is seen at that pixel, wherever the corner is: that pixel can be found again.
  fresh.covariance_K = covariance_C(feature, camera, *feature.depth_m, patch_sigma_px);
  fresh.descriptor = feature.descriptor;
  fresh.octave = feature.octave;
  fresh.distance_m = fresh.p_K.norm();
  landmarks_.push_back(std::move(fresh));
  return static_cast<int>(landmarks_.size()) - 1;
}

Vec3 LandmarkMap::p_W(int id) const {
  const Landmark& mark = landmark(id);
  return keyframes_[mark.anchor].X_WC * mark.p_K;
}

Eigen::Matrix3d LandmarkMap::covariance_W(int id) const {
  const Landmark& mark = landmark(id);
  const Eigen::Matrix3d R = keyframes_[mark.anchor].X_WC.linear();
  return R * mark.covariance_K * R.transpose();
}

void LandmarkMap::observe(int id,
                          const Feature& feature,
                          const CameraModel& camera,
                          const Pose& X_WC) {
  Landmark& mark = landmarks_[static_cast<std::size_t>(id)];
  ++mark.found;
  const Pose X_CK = X_WC.inverse() * keyframes_[mark.anchor].X_WC;
  const Vec3 p_C = X_CK * mark.p_K;
  if (!feature.depth_m || p_C.z() <= 0.0) {
    return;
  }
  // Measured as a point in C: the covariance is that of one view, plus the pose's. It is taken at
  // the expected depth: at the measured one, the shorter of two would always weigh more.
  const Vec3 seen_C = back_projected(camera, feature.pixel, *feature.depth_m);
  Eigen::Matrix3d noise = covariance_C(feature, camera, p_C.z(), feature.sigma_px);
  noise.diagonal().array() += pose_sigma_m * pose_sigma_m;
  const Eigen::Matrix3d R_CK = X_CK.linear();
  const Eigen::Matrix3d prior_C = R_CK * mark.covariance_K * R_CK.transpose();
  const Eigen::Matrix3d gain = prior_C * (prior_C + noise).inverse();
  const Vec3 fused_C = p_C + gain * (seen_C - p_C);
  const Eigen::Matrix3d left = (Eigen::Matrix3d::Identity() - gain) * prior_C;
  mark.p_K = X_CK.inverse() * fused_C;
  const Eigen::Matrix3d back = R_CK.transpose() * left * R_CK;
  mark.covariance_K = 0.5 * (back + back.transpose());
}

bool LandmarkMap::is_doubtful(int id) const {
  const Landmark& mark = landmark(id);
  constexpr int enough = 10;
  return mark.expected > enough && 4 * mark.found < mark.expected;
}

std::vector<std::size_t> LandmarkMap::neighbours(std::size_t keyframe, std::size_t count) const {
  std::vector<std::pair<int, std::size_t>> shared;  // Landmarks, negative for sorting; keyframe.
  for (std::size_t i = 0; i < keyframes_.size(); ++i) {
    shared.emplace_back(0, i);
  }
  for (const int id : keyframes_[keyframe].landmarks) {
    if (id != no_landmark) {
      for (const std::size_t other : landmark(id).seen_by) {
        --shared[other].first;
      }
    }
  }
  shared[keyframe].first = -1'000'000;
  const std::size_t kept = std::min(count, shared.size());
  std::partial_sort(shared.begin(), shared.begin() + static_cast<std::ptrdiff_t>(kept),
                    shared.end());
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < kept && shared[i].first < 0; ++i) {
    best.push_back(shared[i].second);
  }
  return best;
}

std::vector<int> LandmarkMap::landmarks_of(const std::vector<std::size_t>& keyframes) const {
  std::vector<int> all;
  for (const std::size_t keyframe : keyframes) {
    for (const int id : keyframes_[keyframe].landmarks) {
      if (id != no_landmark && !is_doubtful(id)) {
        all.push_back(id);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void LandmarkMap::move(const std::vector<Pose>& X_WC) {
  for (std::size_t i = 0; i < std::min(keyframes_.size(), X_WC.size()); ++i) {
    keyframes_[i].X_WC = X_WC[i];
  }
}

void LandmarkMap::bind(std::size_t old, std::size_t now, const Matrix6& covariance) {
  const double before = keyframes_[now].covariance.trace();
  const double path_m = keyframes_[now].path_m - keyframes_[old].path_m;
  if (!(before > covariance.trace()) || !(path_m > 0.0)) {
    return;
  }
  const double left = covariance.trace() / before;
  for (std::size_t i = old + 1; i <= now; ++i) {
    // The path does not grow from each keyframe to the next where an old place was found again.
    const double share =
        std::clamp((keyframes_[i].path_m - keyframes_[old].path_m) / path_m, 0.0, 1.0);
    keyframes_[i].covariance *= 1.0 - share * (1.0 - left);
  }
}

void LandmarkMap::merge(std::size_t keyframe, std::size_t feature, int id) {
  keyframes_[keyframe].landmarks[feature] = id;
  landmarks_[static_cast<std::size_t>(id)].seen_by.push_back(keyframe);
}

}  // namespace flyball
