// SPDX-License-Identifier: BSD-3-Clause
#include "visual/pose_solver.h"

#include "visual/feature.h"
#include "visual/motion.h"
#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>

namespace flyball {
namespace {

constexpr int max_samples = 200;
constexpr double confidence = 0.99;
constexpr float reach_px = 4.0F;  // Of RANSAC; `refine` judges by uncertainty afterwards.
constexpr double nearest_m = 0.05;
constexpr double limit_2 = 5.99;  // 95 % quantiles of chi-square: a pixel, and a pixel with depth.
constexpr double limit_3 = 7.81;

/// Residual of one sighting over its uncertainty.
struct Misfit {
  int rows{};  ///< 2, or 3 with depth; 0 for a point behind the camera.
  Vec3 by{Vec3::Zero()};
  Eigen::Matrix<double, 3, 6> slope{Eigen::Matrix<double, 3, 6>::Zero()};  ///< By (p, r) of C.
  Eigen::Matrix3d information{Eigen::Matrix3d::Zero()};
  double chi_square{};

  [[nodiscard]] bool fits() const {
    return rows > 0 && chi_square < (rows == 3 ? limit_3 : limit_2);
  }
};

Misfit misfit(const LandmarkSighting& seen, const CameraModel& camera, const Pose& X_WC) {
  Misfit miss;
  const Eigen::Matrix3d R_CW = X_WC.linear().transpose();
  const Vec3 p_C = R_CW * (seen.p_W - X_WC.translation());
  if (p_C.z() < nearest_m) {
    return miss;
  }
  const Projection at = project(camera, p_C);
  miss.rows = seen.depth_m ? 3 : 2;
  Eigen::Matrix3d by_p_C = Eigen::Matrix3d::Zero();
  by_p_C.topRows<2>() = at.by_p_C;
  miss.by.head<2>() = seen.pixel - at.pixel;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Identity() * (seen.sigma_px * seen.sigma_px);
  if (seen.depth_m) {
    by_p_C(2, 2) = 1.0;
    miss.by.z() = *seen.depth_m - p_C.z();
    // By the expected depth: by the measured one, the shorter of two would always weigh more.
    noise(2, 2) = std::pow(depth_sigma_m(p_C.z()), 2) + seen.slant_sigma_m * seen.slant_sigma_m;
  } else {
    noise(2, 2) = 1.0;  // A row of zeros.
  }
  // Moving C by (p, r) moves the point in C by -p + p_C x r.
  miss.slope.leftCols<3>() = -by_p_C;
  miss.slope.rightCols<3>() = by_p_C * skew(p_C);
  const Eigen::Matrix3d spread =
      by_p_C * (R_CW * seen.covariance_W * R_CW.transpose()) * by_p_C.transpose() + noise;
  miss.information = spread.inverse();
  miss.chi_square = miss.by.dot(miss.information * miss.by);
  return miss;
}

/// Of least squares with Huber's weights.
struct NormalEquations {
  Matrix6 normal{Matrix6::Zero()};
  Vec6 right{Vec6::Zero()};
};

NormalEquations equations(const std::vector<LandmarkSighting>& sightings,
                          const std::vector<bool>& use,
                          const CameraModel& camera,
                          const Pose& X_WC) {
  NormalEquations sum;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!use[i]) {
      continue;
    }
    const Misfit miss = misfit(sightings[i], camera, X_WC);
    if (miss.rows == 0) {
      continue;
    }
    const double size = std::sqrt(miss.chi_square);
    constexpr double huber = 1.345;  // 95 % as efficient as least squares on normal noise.
    const double weight = size > huber ? huber / size : 1.0;
    const Eigen::Matrix<double, 6, 3> back = miss.slope.transpose() * miss.information * weight;
    sum.normal += back * miss.slope;
    sum.right += back * miss.by;
  }
  return sum;
}

/// One step of Gauss-Newton; false when the sightings do not determine it.
bool improve(const std::vector<LandmarkSighting>& sightings,
             const std::vector<bool>& use,
             const CameraModel& camera,
             Pose& X_WC) {
  const auto [normal, right] = equations(sightings, use, camera, X_WC);
  const Eigen::LDLT<Matrix6> solver{normal};
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-9)) {
    return false;
  }
  const Vec6 step = solver.solve(right);
  if (!step.allFinite()) {
    return false;
  }
  X_WC = moved(X_WC, step);
  return step.norm() > 1e-7;
}

/// The inverse of the information in what fits. What is not determined is uncertain by a kilometre.
Matrix6 covariance_of(const std::vector<LandmarkSighting>& sightings,
                      const SolvedPose& solved,
                      const CameraModel& camera) {
  constexpr double least_information = 1e-6;
  Matrix6 information = equations(sightings, solved.fits, camera, solved.X_WC).normal;
  information.diagonal().array() += least_information;
  return information.ldlt().solve(Matrix6::Identity());
}

/// How many samples OpenCV draws until it is as sure as it was told to be (its
/// RANSACUpdateNumIters): it does not report the number itself.
double samples_drawn(std::size_t points, std::size_t inliers) {
  const double share = static_cast<double>(inliers) / static_cast<double>(points);
  if (inliers == 0) {
    return static_cast<double>(max_samples);  // All of them, and none was a pose.
  }
  const double all_good = std::pow(share, 4.0);
  if (all_good >= 1.0 - 1e-12) {
    return 1.0;
  }
  return std::clamp(std::ceil(std::log(1.0 - confidence) / std::log(1.0 - all_good)), 1.0,
                    static_cast<double>(max_samples));
}

Pose pose_of(const cv::Mat& rotation, const cv::Mat& translation) {
  cv::Mat R;
  cv::Rodrigues(rotation, R);
  Pose X_CW = Pose::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      X_CW.linear()(row, column) = R.at<double>(row, column);
    }
    X_CW.translation()[row] = translation.at<double>(row);
  }
  return X_CW.inverse();
}

std::optional<Pose> sampled_pose(const std::vector<LandmarkSighting>& sightings,
                                 const CameraModel& camera,
                                 int least,
                                 Work& work) {
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> pixels;
  for (const LandmarkSighting& seen : sightings) {
    places.emplace_back(seen.p_W.x(), seen.p_W.y(), seen.p_W.z());
    pixels.emplace_back(seen.pixel.x(), seen.pixel.y());
  }
  const cv::Matx33d matrix{
      camera.focal_x_px, 0, camera.centre_x_px, 0, camera.focal_y_px, camera.centre_y_px, 0, 0, 1};
  cv::Mat rotation;
  cv::Mat translation;
  std::vector<int> inliers;
  try {
    cv::setRNGSeed(1);  // OpenCV's generator is the thread's; each call begins it anew.
    const bool solved =
        cv::solvePnPRansac(places, pixels, matrix, cv::noArray(), rotation, translation, false,
                           max_samples, reach_px, confidence, inliers, cv::SOLVEPNP_P3P);
    work.add("ransac_iterations", samples_drawn(sightings.size(), inliers.size()));
    if (!solved || static_cast<int>(inliers.size()) < least) {
      return std::nullopt;
    }
    const Pose X_WC = pose_of(rotation, translation);
    return X_WC.matrix().allFinite() ? std::optional{X_WC} : std::nullopt;
  } catch (const cv::Exception&) {  // Points on a line, for one: no pose.
    work.add("ransac_iterations", max_samples);
    return std::nullopt;
  }
}

}  // namespace

Projection project(const CameraModel& camera, const Vec3& p_C) {
  const double x = p_C.x() / p_C.z();
  const double y = p_C.y() / p_C.z();
  Projection at;
  at.pixel = {camera.focal_x_px * x + camera.centre_x_px,
              camera.focal_y_px * y + camera.centre_y_px};
  at.by_p_C << camera.focal_x_px / p_C.z(), 0.0, -camera.focal_x_px * x / p_C.z(),  //
      0.0, camera.focal_y_px / p_C.z(), -camera.focal_y_px * y / p_C.z();
  return at;
}

Vec3 back_projected(const CameraModel& camera, const Eigen::Vector2d& pixel, double depth_m) {
  return depth_m * Vec3{(pixel.x() - camera.centre_x_px) / camera.focal_x_px,
                        (pixel.y() - camera.centre_y_px) / camera.focal_y_px, 1.0};
}

SolvedPose refine(const std::vector<LandmarkSighting>& sightings,
                  const CameraModel& camera,
                  const Pose& X_WC_guess) {
  SolvedPose solved;
  solved.X_WC = X_WC_guess;
  solved.fits.assign(sightings.size(), true);
  constexpr int rounds = 3;  // All with Huber's weights, then twice the ones that fit.
  constexpr int steps = 8;
  for (int round = 0; round < rounds; ++round) {
    for (int step = 0; step < steps; ++step) {
      if (!improve(sightings, solved.fits, camera, solved.X_WC)) {
        break;
      }
    }
    solved.inliers = 0;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      solved.fits[i] = misfit(sightings[i], camera, solved.X_WC).fits();
      solved.inliers += solved.fits[i] ? 1 : 0;
    }
  }
  solved.covariance = covariance_of(sightings, solved, camera);
  return solved;
}

std::optional<SolvedPose> solve_pose(const std::vector<LandmarkSighting>& sightings,
                                     const CameraModel& camera,
                                     int least,
                                     Work& work) {
  if (static_cast<int>(sightings.size()) < std::max(least, 6)) {
    return std::nullopt;
  }
  const std::optional<Pose> guess = sampled_pose(sightings, camera, std::max(6, least / 2), work);
  if (!guess) {
    return std::nullopt;
  }
  SolvedPose solved = refine(sightings, camera, *guess);
  return solved.inliers >= least ? std::optional{std::move(solved)} : std::nullopt;
}

}  // namespace flyball
