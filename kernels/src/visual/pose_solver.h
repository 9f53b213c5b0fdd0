// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A camera's pose from landmarks whose places are roughly known.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/work.h"

#include "visual/motion.h"
#include <optional>

namespace flyball {

/// A landmark where it is believed to be, and where the camera sees it.
struct LandmarkSighting {
  Vec3 p_W{Vec3::Zero()};
  Eigen::Matrix3d covariance_W{Eigen::Matrix3d::Zero()};  ///< Of `p_W` [m^2].
  Eigen::Vector2d pixel{Eigen::Vector2d::Zero()};         ///< Without distortion.
  double sigma_px{1.0};
  std::optional<double> depth_m{};
  double slant_sigma_m{};  ///< Of the depth, because the pixel is uncertain on a slanted surface.
};

struct SolvedPose {
  Pose X_WC{Pose::Identity()};
  std::vector<bool> fits{};  ///< Of each sighting.
  int inliers{};
  Matrix6 covariance{Matrix6::Zero()};  ///< Of (p, r) in C, the landmarks' frame taken as known.
};

/// Random samples of four points (P3P) around which the rest must gather; then `refine`. The
/// samples are always the same. Adds `ransac_iterations` to `work`.
///
/// @return Empty when fewer than `least` sightings agree.
[[nodiscard]] std::optional<SolvedPose> solve_pose(const std::vector<LandmarkSighting>& sightings,
                                                   const CameraModel& camera,
                                                   int least,
                                                   Work& work);

/// Gauss-Newton on pixels and depths from a pose close by, each weighted by its own and its
/// landmark's uncertainty; sightings that miss by more than the 95 % quantile are left out.
[[nodiscard]] SolvedPose refine(const std::vector<LandmarkSighting>& sightings,
                                const CameraModel& camera,
                                const Pose& X_WC_guess);

/// Where a camera without distortion sees a point, and how that moves with it.
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_p_C;
};
/// @pre `p_C.z() > 0`.
[[nodiscard]] Projection project(const CameraModel& camera, const Vec3& p_C);

/// The point at a depth behind a pixel.
[[nodiscard]] Vec3 back_projected(const CameraModel& camera,
                                  const Eigen::Vector2d& pixel,
                                  double depth_m);

}  // namespace flyball
