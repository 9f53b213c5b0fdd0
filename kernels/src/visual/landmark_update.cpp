// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_inertial
#include "visual/landmark_update.h"

#include "visual/feature.h"
#include "visual/motion.h"
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace flyball {
namespace {

constexpr double nearest_used_m = 0.2;
constexpr double farthest_m = 100.0;

Vec3 in_camera(const BodyPose& from, const Vec3& p_W) {
  return from.X_BC.inverse() * (from.X_WB.inverse() * p_W);
}

/// The point nearest to all rays: sum of (I - d d') (p - c) = 0.
std::optional<Vec3> nearest_to_rays(const std::vector<BodyPose>& window,
                                    const std::vector<Glimpse>& glimpses) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  for (const Glimpse& seen : glimpses) {
    const Pose X_WC = window[seen.pose].X_WB * window[seen.pose].X_BC;
    const Vec3 d = (X_WC.linear() * Vec3{seen.ray.x(), seen.ray.y(), 1.0}).normalized();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - d * d.transpose();
    normal += across;
    right += across * X_WC.translation();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shape{normal};
  // The smallest eigenvalue is the sum of the squared angles between the rays and their mean.
  constexpr double widest_apart_rad = 0.01;
  if (shape.eigenvalues()[0] <
      static_cast<double>(glimpses.size()) * widest_apart_rad * widest_apart_rad) {
    return std::nullopt;
  }
  return Vec3{normal.ldlt().solve(right)};
}

/// From all depths that were measured.
std::optional<Vec3> mean_place(const std::vector<BodyPose>& window,
                               const std::vector<Glimpse>& glimpses) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (const Glimpse& seen : glimpses) {
    if (seen.depth_m) {
      const Pose X_WC = window[seen.pose].X_WB * window[seen.pose].X_BC;
      sum += X_WC * Vec3{*seen.depth_m * Vec3{seen.ray.x(), seen.ray.y(), 1.0}};
      count += 1.0;
    }
  }
  return count > 0.0 ? std::optional{Vec3{sum / count}} : std::nullopt;
}

struct Reprojection {
  Eigen::VectorXd miss;     ///< Over its standard deviation, as are the slopes.
  Eigen::MatrixXd by_p_W;   ///< Rows x 3.
  Eigen::MatrixXd by_pose;  ///< Rows x 6, by rotation and place of the pose.
};

/// One glimpse compared with the place.
Reprojection compare(const BodyPose& from, const Glimpse& seen, const Vec3& p_W, double ray_sigma) {
  const Vec3 p_B = from.X_WB.inverse() * p_W;
  const Vec3 p_C = from.X_BC.inverse() * p_B;
  const Eigen::Index rows = seen.depth_m ? 3 : 2;
  Eigen::Matrix3d by_p_C = Eigen::Matrix3d::Zero();
  by_p_C.row(0) << 1.0 / p_C.z(), 0.0, -p_C.x() / (p_C.z() * p_C.z());
  by_p_C.row(1) << 0.0, 1.0 / p_C.z(), -p_C.y() / (p_C.z() * p_C.z());
  by_p_C.row(2) << 0.0, 0.0, 1.0;
  const double depth_sigma = depth_sigma_m(p_C.z());
  Vec3 miss{seen.ray.x() - p_C.x() / p_C.z(), seen.ray.y() - p_C.y() / p_C.z(),
            seen.depth_m.value_or(p_C.z()) - p_C.z()};
  const Vec3 weight{1.0 / ray_sigma, 1.0 / ray_sigma, 1.0 / depth_sigma};
  const Eigen::Matrix3d R_CB = from.X_BC.linear().transpose();
  const Eigen::Matrix3d R_CW = R_CB * from.X_WB.linear().transpose();
  const Eigen::Matrix3d scaled = weight.asDiagonal() * by_p_C;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose.leftCols<3>() = scaled * R_CB * skew(p_B);
  by_pose.rightCols<3>() = -scaled * R_CW;
  miss.array() *= weight.array();
  return {miss.head(rows), (scaled * R_CW).topRows(rows), by_pose.topRows(rows)};
}

}  // namespace

std::optional<Vec3> triangulate(const std::vector<BodyPose>& window,
                                const std::vector<Glimpse>& glimpses,
                                double reach) {
  std::optional<Vec3> p_W = mean_place(window, glimpses);
  if (!p_W) {
    p_W = nearest_to_rays(window, glimpses);
  }
  if (!p_W) {
    return std::nullopt;
  }
  constexpr int steps = 4;
  for (int step = 0; step < steps; ++step) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vec3 right = Vec3::Zero();
    for (const Glimpse& seen : glimpses) {
      if (in_camera(window[seen.pose], *p_W).z() < nearest_used_m) {
        return std::nullopt;
      }
      const Reprojection reprojection = compare(window[seen.pose], seen, *p_W, reach);
      normal += reprojection.by_p_W.transpose() * reprojection.by_p_W;
      right += reprojection.by_p_W.transpose() * reprojection.miss;
    }
    *p_W += normal.ldlt().solve(right);
    if (!p_W->allFinite()) {
      return std::nullopt;
    }
  }
  for (const Glimpse& seen : glimpses) {
    const Vec3 p_C = in_camera(window[seen.pose], *p_W);
    const bool plausible = p_C.z() > nearest_used_m && p_C.z() < farthest_m;
    if (!plausible || (p_C.head<2>() / p_C.z() - seen.ray).norm() > reach) {
      return std::nullopt;
    }
  }
  return p_W;
}

Innovation landmark_innovation(const InertialFilter& filter,
                               const std::vector<Glimpse>& glimpses,
                               const Vec3& p_W,
                               double ray_sigma) {
  Eigen::Index rows = 0;
  for (const Glimpse& seen : glimpses) {
    rows += seen.depth_m ? 3 : 2;
  }
  Eigen::VectorXd miss = Eigen::VectorXd::Zero(rows);
  Eigen::MatrixXd by_p_W = Eigen::MatrixXd::Zero(rows, 3);
  Eigen::MatrixXd by_error = Eigen::MatrixXd::Zero(rows, filter.size());
  Eigen::Index row = 0;
  for (const Glimpse& seen : glimpses) {
    const Reprojection reprojection = compare(filter.window()[seen.pose], seen, p_W, ray_sigma);
    const Eigen::Index count = reprojection.miss.size();
    const auto column = InertialFilter::body_size +
                        InertialFilter::pose_size * static_cast<Eigen::Index>(seen.pose);
    miss.segment(row, count) = reprojection.miss;
    by_p_W.middleRows(row, count) = reprojection.by_p_W;
    by_error.block(row, column, count, InertialFilter::pose_size) = reprojection.by_pose;
    row += count;
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> turned{by_p_W};
  miss.applyOnTheLeft(turned.householderQ().adjoint());
  by_error.applyOnTheLeft(turned.householderQ().adjoint());
  return {miss.tail(rows - 3), by_error.bottomRows(rows - 3), Eigen::VectorXd::Ones(rows - 3)};
}

}  // namespace flyball
