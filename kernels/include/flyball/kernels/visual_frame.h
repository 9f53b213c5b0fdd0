// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a localizer sees, and what it makes of it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/time.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// How a lens bends directions, by four coefficients.
enum class DistortionModel {
  radial_tangential,  ///< k1, k2, p1, p2: Brown 1966, as OpenCV and Kalibr's `radtan` have them.
  equidistant,        ///< k1 to k4 of the angle: Kannala & Brandt 2006, OpenCV's `cv::fisheye`.
};

/// Pinhole camera with distortion.
struct CameraModel {
  int width_px{};
  int height_px{};
  double focal_x_px{};
  double focal_y_px{};
  double centre_x_px{};
  double centre_y_px{};
  std::array<double, 4> distortion{};
  DistortionModel distortion_model{DistortionModel::radial_tangential};
};

/// A grey image, and depth of the same view if the camera measures it.
struct VisualFrame {
  MissionTime captured{};
  CameraModel camera{};
  Pose X_BC{Pose::Identity()};       ///< Where the camera was mounted then; a gimbal moves it.
  std::vector<std::uint8_t> grey{};  ///< Row by row, width x height.
  /// Along the optical axis, as many as `grey` or none; infinite, NaN or zero where nothing
  /// returned.
  std::vector<float> depth_m{};
  /// Where the vehicle was then as far as is known without this frame; empty where nothing tells
  /// its height.
  std::optional<Pose> X_WB_reckoned{};
};

/// The pose that one frame gives.
struct VisualFix {
  MissionTime captured{};
  bool tracked{};               ///< Otherwise the frame gave no pose, and the rest is the last one.
  Pose X_WB{Pose::Identity()};  ///< When the frame was captured.
  Vec3 v_WB{Vec3::Zero()};
  /// Of the position, in W, since the start [m^2]: what the localizer itself thinks of its error.
  Eigen::Matrix3d covariance_W{Eigen::Matrix3d::Zero()};
  int matches{};       ///< Known landmarks that were recognised in the frame.
  int inliers{};       ///< Of these, the ones that agree with the pose.
  int keyframes{};     ///< In the map.
  int loops_closed{};  ///< Since the start.

  /// Root mean square of the error that it expects.
  [[nodiscard]] double sigma_m() const { return std::sqrt(covariance_W.trace()); }
};

}  // namespace flyball
