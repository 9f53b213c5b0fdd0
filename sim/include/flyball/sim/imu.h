// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Inertial measurement unit in the body's centre: biases that wander, white noise, and the rotors'
/// vibration.

#include "flyball/runtime/imu.h"
#include "flyball/runtime/random.h"
#include "flyball/sim/vehicle.h"

#include <array>
#include <cstdint>
#include <optional>

namespace flyball {

struct ImuSpec {
  double rate_hz{200.0};
  // ADIS16448, as given for the EuRoC vehicle (Burri et al. 2016).
  double gyro_rad_s_rthz{1.7e-4};        ///< Density of white noise.
  double accel_m_s2_rthz{2.0e-3};        ///< As the gyro's.
  double gyro_walk_rad_s2_rthz{1.9e-5};  ///< Random walk of the bias.
  double accel_walk_m_s3_rthz{3.0e-3};
  double gyro_bias_rad_s{0.005};  ///< Standard deviation of the bias at switching on.
  double accel_bias_m_s2{0.05};
  /// Variance of the accelerometer in hover, measured in flight beside MAVBench's simulated
  /// 1.75e-3: 9.46 (m/s^2)^2. It goes with the fourth power of the rotors' speed.
  double vibration_m2_s4{9.46};
  /// At which `vibration_m2_s4` holds, here that of the Matrice 100 without payload. Any other
  /// vehicle is taken to shake as hard in its own hover (`Imu::set_hover`): what is out of balance
  /// presses with a share of the weight that the rotors carry.
  double hover_rev_s{61.0};
};

class Imu {
 public:
  Imu(const ImuSpec& spec, std::uint64_t seed);

  /// What it feels at `now`. Each rotor's imbalance turns with it: the force has the rotor's
  /// frequency and grows with the square of its speed; the gyro feels a thousandth of it (rad/s per
  /// m/s^2). Calls in order of time.
  [[nodiscard]] ImuSample sample(const VehicleState& state, MissionTime now);
  /// The vehicle hovers at another speed of its rotors from now on: its mass has changed.
  void set_hover(double rev_s) { spec_.hover_rev_s = rev_s; }

 private:
  [[nodiscard]] Vec3 vibration_B(const VehicleState& state, double dt_s);

  ImuSpec spec_;
  RandomStream noise_;
  Vec3 gyro_bias_;
  Vec3 accel_bias_;
  std::array<double, 4> turns_{};  ///< Of each rotor since the start.
  std::optional<MissionTime> last_{};
};

}  // namespace flyball
