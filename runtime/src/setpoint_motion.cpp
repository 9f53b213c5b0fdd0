// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/motion/setpoint_motion.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// Own choices, gentle against a multirotor's limits (the simulated one accelerates by 6 m/s^2).
constexpr double climb_m_s = 1.5;
constexpr double climb_m_s2 = 2.0;
constexpr double stop_m_s2 = 5.0;
// A set-point that speeds up is not believed for longer than five periods of a 50 Hz stream.
constexpr double longest_speed_up_s = 0.1;

}  // namespace

Vec3 stepped_velocity(const Vec3& from, const Vec3& to, double largest) {
  const Vec3 gap = to - from;
  const double length = gap.norm();
  return length <= largest ? to : Vec3{from + gap * (largest / length)};
}

/// p and v run on with a; a braking one stops where it would turn round.
Setpoint extrapolated(const Setpoint& newest, double age_s) {
  Setpoint s = newest;
  const double along = s.a_WB.dot(s.v_WB);
  const double until_stop_s = along < 0.0 ? -s.v_WB.squaredNorm() / along : longest_speed_up_s;
  const double pushed_s = std::clamp(age_s, 0.0, until_stop_s);
  s.p_WB += pushed_s * s.v_WB + 0.5 * pushed_s * pushed_s * s.a_WB;
  s.v_WB += pushed_s * s.a_WB;
  if (age_s > pushed_s) {
    s.v_WB = along < 0.0 ? Vec3::Zero().eval() : s.v_WB;
    s.p_WB += (age_s - pushed_s) * s.v_WB;
    s.a_WB = Vec3::Zero();
  }
  s.yaw_rad += age_s * s.yaw_rate_rad_s;
  return s;
}

void brake_reference(Setpoint& reference, double dt_s) {
  reference.v_WB = stepped_velocity(reference.v_WB, Vec3::Zero(), stop_m_s2 * dt_s);
}

void climb_reference(Setpoint& reference, double height_m, double dt_s) {
  const double left_m = height_m - reference.p_WB.z();
  const double speed = std::min(climb_m_s, std::sqrt(2.0 * climb_m_s2 * std::abs(left_m)));
  const Vec3 wanted{0.0, 0.0, std::copysign(speed, left_m)};
  reference.v_WB = stepped_velocity(reference.v_WB, wanted, climb_m_s2 * dt_s);
  if (std::abs(left_m) <= std::abs(reference.v_WB.z()) * dt_s) {
    reference.v_WB = Vec3::Zero();
    reference.p_WB.z() = height_m;
  }
}

void move_reference(Setpoint& reference, const Vec3& before_m_s, double dt_s) {
  reference.p_WB += dt_s * reference.v_WB;
  reference.a_WB = (reference.v_WB - before_m_s) / dt_s;
}

}  // namespace flyball
