// SPDX-License-Identifier: BSD-3-Clause
//
// How the flight controller pushes: acceleration, attitude, rates, rotors.

#include "flyball/sim/flight_controller.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double largest_correction_m_s =
    4.0;  // position loop's say: a far set-point is approached
constexpr double largest_disturbance_m_s2 = 6.0;  // more than any wind that it can fly in
constexpr double most_descent_m_s2 = 7.0;         // keeps 2.8 m/s^2 of thrust to tilt with
constexpr double most_tilt_rate_rad_s = 6.0;      // own choice
constexpr double clear_of_ground_m = 0.03;        // below it the ground carries weight
constexpr double idle_share = 0.12;               // of the rotors' speed: they never stop in flight

/// Rotates `z` towards `goal` (both unit): axis times angle.
Vec3 rotation_between(const Vec3& z, const Vec3& goal) {
  const Vec3 cross = z.cross(goal);
  const double sine = cross.norm();
  const double angle = std::atan2(sine, z.dot(goal));
  return sine > 1e-12 ? Vec3{cross * (angle / sine)} : Vec3::Zero();
}

Vec3 limited(const Vec3& v, double largest) {
  const double length = v.norm();
  return length > largest ? Vec3{v * (largest / length)} : v;
}

}  // namespace

/// Thrust is known from the rotors' speeds and acceleration is measured: what is left is wind, drag
/// and a wrong belief about the mass. Unlike an integral of the velocity error it does not wind up
/// while the attitude still changes, so braking does not overshoot.
void FlightController::observe(const VehicleState& state, double total_mass_kg, double dt_s) {
  if (feet_height_m(state) < clear_of_ground_m) {
    return;
  }
  double thrust_n = 0.0;
  for (const double n : state.rotor_rev_s) {
    thrust_n += airframe_.thrust_per_n2() * n * n;
  }
  const Vec3 expected =
      thrust_n / total_mass_kg * state.X_WB.linear().col(2) - gravity_m_s2 * Vec3::UnitZ();
  const double share = 1.0 - std::exp(-dt_s / gains_.disturbance_s);
  disturbance_ += share * (state.a_WB - expected - disturbance_);
  disturbance_ = limited(disturbance_, largest_disturbance_m_s2);
}

/// Thrust over mass that follows the set-point, within the tilt limit.
Vec3 FlightController::specific_force(const VehicleState& state, const Setpoint& wanted) const {
  const Vec3 position_gain{gains_.position, gains_.position, gains_.height};
  const Vec3 velocity_gain{gains_.velocity, gains_.velocity, gains_.climb};
  const Vec3 correction = position_gain.cwiseProduct(wanted.p_WB - state.X_WB.translation());
  const Vec3 velocity = wanted.v_WB + limited(correction, largest_correction_m_s);
  Vec3 f = wanted.a_WB + velocity_gain.cwiseProduct(velocity - state.v_WB) - disturbance_;
  f.z() = gravity_m_s2 + std::max(-most_descent_m_s2, f.z());
  const double most_sideways = f.z() * std::tan(gains_.max_tilt_rad);
  const double sideways = f.head<2>().norm();
  if (sideways > most_sideways) {
    f.head<2>() *= most_sideways / sideways;
  }
  return f;
}

/// Tilt by the shortest rotation, heading apart from it: a vehicle that must brake does not wait
/// for its nose.
Vec3 FlightController::torque(const VehicleState& state, const Vec3& force_W) const {
  const Eigen::Matrix3d R_WB = state.X_WB.linear();
  const Vec3 tilt_B = rotation_between(Vec3::UnitZ(), R_WB.transpose() * force_W.normalized());
  const double yaw_error = wrap_angle(yaw_rad_ - yaw_of(R_WB.col(0)));
  const Vec3 tilt_rate = limited(gains_.attitude * tilt_B, most_tilt_rate_rad_s);
  const Vec3 turn_B = R_WB.transpose() * Vec3{0.0, 0.0, yaw_rate_rad_s_ + gains_.yaw * yaw_error};
  const Vec3 w_wanted{tilt_rate.x() + turn_B.x(), tilt_rate.y() + turn_B.y(), turn_B.z()};
  const Vec3 gains{gains_.rate, gains_.rate, gains_.yaw_rate};
  const Vec3 inertia = airframe_.inertia_kg_m2();
  const Vec3& w = state.w_WB_B;
  Vec3 turn = gains.cwiseProduct(w_wanted - w);
  turn.z() += yaw_acceleration_rad_s2_;
  return inertia.cwiseProduct(turn) + w.cross(inertia.cwiseProduct(w));
}

/// Thrust per rotor is the sum of collective, tilt and yaw shares. What does not fit between idle
/// and full speed is given up in the order yaw, collective, tilt.
RotorSpeeds FlightController::mix(double thrust_n, const Vec3& torque_B) const {
  const double per_n2 = airframe_.thrust_per_n2();
  const double top_n = per_n2 * std::pow(airframe_.max_rotor_rev_s(), 2);
  const double bottom_n = idle_share * idle_share * top_n;
  const auto points = airframe_.rotor_points_B();
  const double arm2 = 2.0 * airframe_.arm_m * airframe_.arm_m;  // 4 l^2 with l = arm / sqrt(2)
  const double yaw_arm = airframe_.torque_per_n2() / per_n2;
  Eigen::Array4d tilt;
  Eigen::Array4d yaw;
  for (int i = 0; i < 4; ++i) {
    const Vec3& p = points[static_cast<std::size_t>(i)];
    tilt[i] = (torque_B.x() * p.y() - torque_B.y() * p.x()) / arm2;
    yaw[i] = (i % 2 == 0 ? 0.25 : -0.25) * torque_B.z() / yaw_arm;
  }
  const double spread = tilt.maxCoeff() - tilt.minCoeff();
  tilt *= spread > top_n - bottom_n ? (top_n - bottom_n) / spread : 1.0;
  // Not std::clamp: where the tilt takes all the room, rounding may put the bounds the wrong way.
  const double collective =
      std::min(std::max(0.25 * thrust_n, bottom_n - tilt.minCoeff()), top_n - tilt.maxCoeff());
  const Eigen::Array4d base = collective + tilt;
  double share = 1.0;
  for (int i = 0; i < 4; ++i) {
    const double room = yaw[i] > 0.0 ? top_n - base[i] : base[i] - bottom_n;
    share = std::min(share, std::max(0.0, room) / std::max(1e-12, std::abs(yaw[i])));
  }
  RotorSpeeds speeds{};
  for (int i = 0; i < 4; ++i) {
    speeds[static_cast<std::size_t>(i)] =
        std::sqrt(std::max(bottom_n, base[i] + share * yaw[i]) / per_n2);
  }
  return speeds;
}

RotorSpeeds FlightController::update(const VehicleState& state,
                                     double total_mass_kg,
                                     MissionTime now,
                                     double dt_s) {
  if (mode_ == FlightMode::idle) {
    return {};
  }
  observe(state, total_mass_kg, dt_s);
  const Setpoint wanted = target(state, now, dt_s);
  if (mode_ == FlightMode::idle) {  // It has just landed.
    return {};
  }
  slew_yaw(wanted, dt_s);
  const Vec3 force_W = specific_force(state, wanted);
  const double thrust_n = total_mass_kg * std::max(0.0, force_W.dot(state.X_WB.linear().col(2)));
  RotorSpeeds command = mix(thrust_n, torque(state, force_W));
  // Commanding past the goal makes a slow rotor quick; the vehicle clamps what it cannot turn.
  const double lead = std::max(1.0, airframe_.rotor_lag_s / gains_.rotor_s);
  for (std::size_t i = 0; i < 4; ++i) {
    const double n = state.rotor_rev_s[i];
    command[i] = std::clamp(n + lead * (command[i] - n), 0.0, airframe_.max_rotor_rev_s());
  }
  return command;
}

}  // namespace flyball
