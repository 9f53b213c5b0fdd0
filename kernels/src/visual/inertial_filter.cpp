// SPDX-License-Identifier: BSD-3-Clause
#include "visual/inertial_filter.h"

#include "visual/motion.h"
#include <cmath>

namespace flyball {
namespace {

using Matrix15 = Eigen::Matrix<double, InertialFilter::body_size, InertialFilter::body_size>;

Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& R) {
  return Eigen::Quaterniond{R}.normalized().toRotationMatrix();
}

}  // namespace

double chi_square_95(double degrees) {
  const double a = 2.0 / (9.0 * degrees);
  constexpr double normal_95 = 1.6448536;
  return degrees * std::pow(1.0 - a + normal_95 * std::sqrt(a), 3.0);
}

void InertialFilter::start(const Pose& X_WB, double tilt_sigma_rad) {
  X_WB_ = X_WB;
  v_WB_ = gyro_bias_ = accel_bias_ = Vec3::Zero();
  window_.clear();
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(body_size);
  // Place and heading are where the map begins: certain. The tilt is uncertain around level axes.
  constexpr double certain = 1e-4;
  constexpr double still_m_s = 0.02;
  sigma.segment<3>(rotation).setConstant(tilt_sigma_rad);
  sigma.segment<3>(position).setConstant(certain);
  sigma.segment<3>(velocity).setConstant(still_m_s);
  sigma.segment<3>(gyro_bias).setConstant(noise_.gyro_bias_rad_s);
  sigma.segment<3>(accel_bias).setConstant(noise_.accel_bias_m_s2);
  covariance_ = sigma.array().square().matrix().asDiagonal();
  const Vec3 up_B = X_WB.linear().transpose() * Vec3::UnitZ();
  covariance_.block<3, 3>(rotation, rotation) -=
      (tilt_sigma_rad * tilt_sigma_rad - certain * certain) * up_B * up_B.transpose();
}

void InertialFilter::propagate(const ImuSample& measured, double dt_s, double shaking_m_s2) {
  const Vec3 w_B = measured.w_WB_B - gyro_bias_;
  const Vec3 f_B = measured.f_B - accel_bias_;
  const Eigen::Matrix3d R = X_WB_.linear();
  const Eigen::Matrix3d half = R * rotation_of(0.5 * dt_s * w_B);  // Attitude in the middle.
  const Vec3 a_W = half * f_B + gravity_W();

  Matrix15 F = Matrix15::Zero();  // d error / dt; Mourikis & Roumeliotis 2007, eq. 10.
  F.block<3, 3>(rotation, rotation) = -skew(w_B);
  F.block<3, 3>(rotation, gyro_bias) = -Eigen::Matrix3d::Identity();
  F.block<3, 3>(position, velocity) = Eigen::Matrix3d::Identity();
  F.block<3, 3>(velocity, rotation) = -half * skew(f_B);
  F.block<3, 3>(velocity, accel_bias) = -half;
  const Matrix15 step = F * dt_s;
  const Matrix15 forward = Matrix15::Identity() + step + 0.5 * step * step;

  X_WB_.translation() += dt_s * v_WB_ + 0.5 * dt_s * dt_s * a_W;
  v_WB_ += dt_s * a_W;
  X_WB_.linear() = orthonormal(R * rotation_of(dt_s * w_B));

  covariance_.topLeftCorner<body_size, body_size>() =
      (forward * covariance_.topLeftCorner<body_size, body_size>() * forward.transpose()).eval();
  if (const Eigen::Index rest = size() - body_size; rest > 0) {
    covariance_.topRightCorner(body_size, rest) =
        (forward * covariance_.topRightCorner(body_size, rest)).eval();
    covariance_.bottomLeftCorner(rest, body_size) =
        covariance_.topRightCorner(body_size, rest).transpose();
  }
  const auto add = [&](Eigen::Index at, double variance) {
    covariance_.diagonal().segment<3>(at).array() += variance;
  };
  add(rotation, std::pow(noise_.gyro_rad_s_rthz, 2) * dt_s);
  add(velocity, std::pow(noise_.accel_m_s2_rthz, 2) * dt_s + std::pow(shaking_m_s2 * dt_s, 2));
  add(gyro_bias, std::pow(noise_.gyro_walk_rad_s2_rthz, 2) * dt_s);
  add(accel_bias, std::pow(noise_.accel_walk_m_s3_rthz, 2) * dt_s);
}

void InertialFilter::remember(MissionTime captured, const Pose& X_BC) {
  const Eigen::Index old = size();
  window_.push_back({captured, X_WB_, X_BC});
  covariance_.conservativeResize(old + pose_size, old + pose_size);
  // The new pose is the body's: its rows are copies (eq. 14-16).
  covariance_.block(old, 0, pose_size, old) = covariance_.block(rotation, 0, pose_size, old);
  covariance_.block(0, old, old, pose_size) = covariance_.block(0, rotation, old, pose_size);
  covariance_.block(old, old, pose_size, pose_size) =
      covariance_.block(rotation, rotation, pose_size, pose_size).eval();
}

void InertialFilter::forget_oldest() {
  const Eigen::Index rest = size() - body_size - pose_size;
  Eigen::MatrixXd less(body_size + rest, body_size + rest);
  less.topLeftCorner(body_size, body_size) = covariance_.topLeftCorner(body_size, body_size);
  less.topRightCorner(body_size, rest) = covariance_.topRightCorner(body_size, rest);
  less.bottomLeftCorner(rest, body_size) = covariance_.bottomLeftCorner(rest, body_size);
  less.bottomRightCorner(rest, rest) = covariance_.bottomRightCorner(rest, rest);
  covariance_ = std::move(less);
  window_.erase(window_.begin());
}

double InertialFilter::surprise(const Innovation& innovation) const {
  Eigen::MatrixXd S = innovation.slope * covariance_ * innovation.slope.transpose();
  S.diagonal().array() += innovation.sigma.array().square();
  return innovation.residual.dot(S.ldlt().solve(innovation.residual));
}

bool InertialFilter::believe(const Innovation& innovation) {
  if (surprise(innovation) > chi_square_95(static_cast<double>(innovation.residual.size()))) {
    return false;
  }
  correct(innovation);
  return true;
}

void InertialFilter::correct(const Innovation& innovation) {
  const Eigen::MatrixXd weighted =
      innovation.sigma.array().square().inverse().matrix().asDiagonal() * innovation.slope;
  if (innovation.residual.size() > size()) {
    // More rows than states: (P^-1 + H' W H)^-1 H' W, as P (1 + H' W H P)^-1 H' W, spares the
    // inverse of a matrix as large as the measurement.
    const Eigen::MatrixXd known = weighted.transpose() * innovation.slope;
    const Eigen::MatrixXd whole = Eigen::MatrixXd::Identity(size(), size()) + known * covariance_;
    const Eigen::MatrixXd narrowed =
        whole.transpose().partialPivLu().solve(covariance_).transpose();
    const Eigen::VectorXd error = narrowed * (weighted.transpose() * innovation.residual);
    accept(error, narrowed);
    return;
  }
  const Eigen::MatrixXd P_ht = covariance_ * innovation.slope.transpose();
  Eigen::MatrixXd S = innovation.slope * P_ht;
  S.diagonal().array() += innovation.sigma.array().square();
  const Eigen::MatrixXd K = S.ldlt().solve(P_ht.transpose()).transpose();
  accept(K * innovation.residual, covariance_ - K * P_ht.transpose());
}

void InertialFilter::accept(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  if (!error.allFinite() || !covariance.allFinite()) {
    return;
  }
  covariance_ = 0.5 * (covariance + covariance.transpose());
  add_to_state(error);
}

void InertialFilter::add_to_state(const Eigen::VectorXd& error) {
  X_WB_.linear() = orthonormal(X_WB_.linear() * rotation_of(error.segment<3>(rotation)));
  X_WB_.translation() += error.segment<3>(position);
  v_WB_ += error.segment<3>(velocity);
  gyro_bias_ += error.segment<3>(gyro_bias);
  accel_bias_ += error.segment<3>(accel_bias);
  Eigen::Index at = body_size;
  for (BodyPose& pose : window_) {
    pose.X_WB.linear() = orthonormal(pose.X_WB.linear() * rotation_of(error.segment<3>(at)));
    pose.X_WB.translation() += error.segment<3>(at + 3);
    at += pose_size;
  }
}

}  // namespace flyball
