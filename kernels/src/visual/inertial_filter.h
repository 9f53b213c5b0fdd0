// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Pose, speed and the sensors' biases from inertial measurements, corrected by what a camera sees.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/imu.h"

#include <deque>
#include <optional>
#include <vector>

namespace flyball {

/// Defaults: MEMS of a flight controller (ADIS16448, the EuRoC vehicle's, is given as 1.7e-4,
/// 2.0e-3, 1.9e-5, 3.0e-3), taken wider since turn-on bias drifts with temperature.
struct InertialNoise {
  double gyro_rad_s_rthz{3e-4};
  double accel_m_s2_rthz{4e-3};
  double gyro_walk_rad_s2_rthz{4e-5};
  double accel_walk_m_s3_rthz{4e-3};
  double gyro_bias_rad_s{0.02};  ///< Standard deviation at the start.
  double accel_bias_m_s2{0.1};
};

/// Where the body was when an image was taken.
struct BodyPose {
  MissionTime captured{};
  Pose X_WB{Pose::Identity()};
  Pose X_BC{Pose::Identity()};  ///< Known.
};

/// What a measurement says about the error state: `residual` = `slope` * error + noise.
struct Innovation {
  Eigen::VectorXd residual{};
  Eigen::MatrixXd slope{};
  Eigen::VectorXd sigma{};
};

/// Error-state Kalman filter with a window of past poses: Mourikis & Roumeliotis 2007,
/// doi:10.1109/ROBOT.2007.364024. Error state: rotation of B in B, p_WB, v_WB, gyro bias,
/// accelerometer bias, then rotation and p_WB of each pose in the window, oldest first.
class InertialFilter {
 public:
  static constexpr Eigen::Index rotation = 0;
  static constexpr Eigen::Index position = 3;
  static constexpr Eigen::Index velocity = 6;
  static constexpr Eigen::Index gyro_bias = 9;
  static constexpr Eigen::Index accel_bias = 12;
  static constexpr Eigen::Index body_size = 15;
  static constexpr Eigen::Index pose_size = 6;

  explicit InertialFilter(const InertialNoise& noise) : noise_{noise} {}

  /// At rest here; its tilt known to `tilt_sigma_rad`.
  void start(const Pose& X_WB, double tilt_sigma_rad);
  /// Goes on by `dt_s` with one measurement. `shaking_m_s2`: standard deviation of the vibration in
  /// the accelerometer, taken as white noise of that size.
  void propagate(const ImuSample& measured, double dt_s, double shaking_m_s2);
  /// The pose of now joins the window.
  void remember(MissionTime captured, const Pose& X_BC);
  void forget_oldest();
  /// Kalman update. What misses by more than the 95 % quantile of chi-square is not believed.
  /// @return Whether it was.
  bool believe(const Innovation& innovation);
  /// Kalman update without that question.
  void correct(const Innovation& innovation);

  /// How far it misses, in units of its variance: chi-square with as many degrees as rows.
  [[nodiscard]] double surprise(const Innovation& innovation) const;

  [[nodiscard]] const Pose& X_WB() const { return X_WB_; }
  [[nodiscard]] const Vec3& v_WB() const { return v_WB_; }
  [[nodiscard]] const Vec3& gyro_bias_now() const { return gyro_bias_; }
  [[nodiscard]] const Vec3& accel_bias_now() const { return accel_bias_; }
  [[nodiscard]] const std::vector<BodyPose>& window() const { return window_; }
  [[nodiscard]] Eigen::Index size() const { return covariance_.rows(); }
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }

 private:
  void accept(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance);
  void add_to_state(const Eigen::VectorXd& error);

  InertialNoise noise_;
  Pose X_WB_{Pose::Identity()};
  Vec3 v_WB_{Vec3::Zero()};
  Vec3 gyro_bias_{Vec3::Zero()};
  Vec3 accel_bias_{Vec3::Zero()};
  std::vector<BodyPose> window_{};
  Eigen::MatrixXd covariance_{};
};

/// Standard gravity in W [m/s^2].
[[nodiscard]] inline Vec3 gravity_W() {
  return {0.0, 0.0, -9.80665};
}

/// 95 % quantile of chi-square (Wilson & Hilferty 1931): within 1 % for two degrees of freedom and
/// more.
[[nodiscard]] double chi_square_95(double degrees);

}  // namespace flyball
