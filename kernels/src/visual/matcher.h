// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which feature of a frame is which landmark.

#include "visual/landmark_map.h"

namespace flyball {

struct Match {
  std::size_t feature{};
  int landmark{};
  int difference{};  ///< Of the descriptors, 0..256.
};

/// The features of one frame by place.
class FeatureGrid {
 public:
  FeatureGrid(const std::vector<Feature>& features, const CameraModel& camera);
  [[nodiscard]] const std::vector<Feature>& features() const { return features_; }
  /// Indices of features in a square around a pixel that is in the image.
  void around(const Eigen::Vector2d& pixel, double radius_px, std::vector<std::size_t>& out) const;

 private:
  [[nodiscard]] std::size_t place_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void add_near(const std::vector<std::size_t>& cell,
                const Eigen::Vector2d& pixel,
                double radius_px,
                std::vector<std::size_t>& out) const;

  const std::vector<Feature>& features_;
  int columns_{};
  int rows_{};
  std::vector<std::vector<std::size_t>> cells_;
};

/// From where, and how far around the place where a landmark should be.
struct LandmarkSearch {
  CameraModel camera{};
  Pose X_WC{Pose::Identity()};
  double radius_px{};
  std::vector<int>* in_view{};  ///< Gets the landmarks that should be seen; may be null.
};

/// Looks for each landmark where a camera at `X_WC` would see it. Adds `matches` (descriptors
/// compared) to `work`.
[[nodiscard]] std::vector<Match> match_by_place(const LandmarkMap& map,
                                                const std::vector<int>& landmarks,
                                                const FeatureGrid& grid,
                                                const LandmarkSearch& view,
                                                Work& work);
/// Compares all features with all landmarks of a keyframe, wherever they are. Adds `matches`.
[[nodiscard]] std::vector<Match> match_by_look(const LandmarkMap& map,
                                               std::size_t keyframe,
                                               const std::vector<Feature>& features,
                                               Work& work);

}  // namespace flyball
