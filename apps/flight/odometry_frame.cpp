// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/odometry_frame.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto memory = 1s;  // Chosen: the answer of the slowest localizer takes less.
// Chosen: slower than a flight controller's position loop (1 /s), and never so fast that the
// vehicle is thrown.
constexpr double gain_1_s = 0.8;
constexpr double max_shift_m_s = 0.5;
constexpr double max_turn_rad_s = 0.2;
constexpr double longest_step_s = 0.1;

/// The part of `error` that is made good in `dt_s`.
Vec3 step_of(const Vec3& error, double dt_s, double max_per_s) {
  const Vec3 step = std::min(1.0, gain_1_s * dt_s) * error;
  const double most = max_per_s * dt_s;
  return step.norm() > most ? Vec3{step.normalized() * most} : step;
}

Eigen::AngleAxisd about_vertical(double angle_rad) {
  return {angle_rad, Vec3::UnitZ()};
}

}  // namespace

void OdometryFrame::note(MissionTime now, const Pose& X_OB) {
  if (!X_OB.matrix().allFinite()) {
    return;
  }
  noted_.push_back({now, X_OB});
  while (noted_.front().at + memory < now) {
    noted_.pop_front();
  }
}

const Pose* OdometryFrame::controller_at(MissionTime at) const {
  const auto later =
      std::upper_bound(noted_.begin(), noted_.end(), at,
                       [](MissionTime t, const Noted& noted) { return t < noted.at; });
  return later != noted_.begin() ? &std::prev(later)->X_OB : nullptr;
}

void OdometryFrame::localized(const PoseEstimate& where, bool is_standing) {
  const Pose* X_OB = controller_at(where.stamp);
  if (X_OB == nullptr || !where.X_WB.matrix().allFinite()) {
    return;
  }
  const double since_s = last_ ? to_seconds(where.stamp - *last_) : 0.0;
  const double dt_s = std::clamp(since_s, 0.0, longest_step_s);
  last_ = where.stamp;
  const Pose found = X_OW_ * where.X_WB;
  const Vec3 p_O = found.translation();
  Vec3 shift_m = X_OB->translation() - p_O;
  double turn_rad = wrap_angle(yaw_of(X_OB->linear().col(0)) - yaw_of(Vec3{found.linear().col(0)}));
  if (!is_standing) {
    shift_m = step_of(shift_m, dt_s, max_shift_m_s);
    turn_rad = step_of({0.0, 0.0, turn_rad}, dt_s, max_turn_rad_s).z();
  }
  X_OW_ = Eigen::Translation3d{p_O + shift_m} * about_vertical(turn_rad) *
          Eigen::Translation3d{-p_O} * X_OW_;
}

Setpoint OdometryFrame::in_odometry(const Setpoint& setpoint) const {
  Setpoint there = setpoint;
  there.p_WB = X_OW_ * setpoint.p_WB;
  there.v_WB = X_OW_.linear() * setpoint.v_WB;
  there.a_WB = X_OW_.linear() * setpoint.a_WB;
  there.yaw_rad = wrap_angle(setpoint.yaw_rad + yaw_of(Vec3{X_OW_.linear().col(0)}));
  return there;
}

}  // namespace flyball
