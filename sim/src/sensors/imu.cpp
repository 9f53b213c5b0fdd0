// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/imu.h"

#include "flyball/sim/airframe.h"

#include "sensors/normal3.h"
#include <cmath>

namespace flyball {
namespace {

constexpr double full_turn_rad = 6.283185307179586;
constexpr double gyro_share = 1e-3;  // rad/s per m/s^2, of a damped mount: an assumption.

}  // namespace

Imu::Imu(const ImuSpec& spec, std::uint64_t seed) : spec_{spec}, noise_{seed, "imu"} {
  gyro_bias_ = spec_.gyro_bias_rad_s * normal3(noise_);
  accel_bias_ = spec_.accel_bias_m_s2 * normal3(noise_);
  for (double& turn : turns_) {
    turn = noise_.uniform();  // No two propellers start at the same angle.
  }
}

/// Four forces that turn in the plane of the rotors, and shake the frame upwards a quarter turn
/// later. On each axis they have the variance that was measured, at hover.
Vec3 Imu::vibration_B(const VehicleState& state, double dt_s) {
  const double amplitude_m_s2 =
      std::sqrt(2.0 * spec_.vibration_m2_s4 / static_cast<double>(turns_.size()));
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    turns_[i] += dt_s * state.rotor_rev_s[i];
    turns_[i] -= std::floor(turns_[i]);
    const double pace = state.rotor_rev_s[i] / spec_.hover_rev_s;
    const double angle = full_turn_rad * turns_[i];
    sum += amplitude_m_s2 * pace * pace *
           Vec3{std::cos(angle), std::sin(angle), std::sin(angle + 0.25 * full_turn_rad)};
  }
  return sum;
}

ImuSample Imu::sample(const VehicleState& state, MissionTime now) {
  const double dt_s = last_ ? to_seconds(now - *last_) : 1.0 / spec_.rate_hz;
  last_ = now;
  const double root_s = std::sqrt(std::max(dt_s, 0.0));
  gyro_bias_ += spec_.gyro_walk_rad_s2_rthz * root_s * normal3(noise_);
  accel_bias_ += spec_.accel_walk_m_s3_rthz * root_s * normal3(noise_);
  const double root_hz = std::sqrt(spec_.rate_hz);
  const Vec3 shaking_B = vibration_B(state, dt_s);
  ImuSample sample;
  sample.stamp = now;
  sample.w_WB_B = state.w_WB_B + gyro_bias_ + spec_.gyro_rad_s_rthz * root_hz * normal3(noise_) +
                  gyro_share * shaking_B;
  sample.f_B = state.X_WB.linear().transpose() * (state.a_WB + gravity_m_s2 * Vec3::UnitZ()) +
               accel_bias_ + spec_.accel_m_s2_rthz * root_hz * normal3(noise_) + shaking_B;
  return sample;
}

}  // namespace flyball
