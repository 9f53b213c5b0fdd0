// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Corners followed from image to image.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <memory>
#include <optional>
#include <vector>

namespace flyball {

/// A corner in the newest image.
struct TrackedPoint {
  std::uint64_t id{};
  /// Direction in C, scaled to z = 1, distortion removed.
  Eigen::Vector2d ray{Eigen::Vector2d::Zero()};
  std::optional<double> depth_m{};
  double moved_px{};  ///< Since the image before; 0 for a new one.
};

struct TrackSettings {
  int count{150};
  int apart_px{14};
};

/// Pyramidal Lucas-Kanade (Bouguet 2000) on Shi-Tomasi corners, checked backwards and against
/// epipolar geometry.
class FeatureTracks {
 public:
  explicit FeatureTracks(const TrackSettings& settings);
  ~FeatureTracks();
  FeatureTracks(const FeatureTracks&) = delete;
  FeatureTracks& operator=(const FeatureTracks&) = delete;

  void clear();
  /// Whether the image is the newest one again, byte for byte, as a camera that hangs sends it.
  [[nodiscard]] bool has_just_seen(const VisualFrame& frame) const;
  /// The points that are still seen, and new ones in between, in order of their ids. Adds `pixels`,
  /// `features` and `tracks` to `work`.
  /// @error `invalid_input` when the image has another size than its camera, `failed` when OpenCV
  ///        refuses it.
  [[nodiscard]] Result<std::vector<TrackedPoint>> follow(const VisualFrame& frame, Work& work);

 private:
  struct Images;
  TrackSettings settings_;
  std::unique_ptr<Images> images_;
};

}  // namespace flyball
