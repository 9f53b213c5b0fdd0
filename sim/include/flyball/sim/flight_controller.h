// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The autopilot: cascaded position, velocity, attitude and rate loops.

#include "flyball/runtime/messages.h"
#include "flyball/sim/airframe.h"
#include "flyball/sim/vehicle.h"

#include <cstdint>

namespace flyball {

enum class FlightMode : std::uint8_t { idle, take_off, hold, velocity, trajectory, land };

class FlightController {
 public:
  FlightController(const Airframe& airframe, double ground_z_m);

  /// Climbs at 1.5 m/s above the present place, then holds.
  void take_off(const VehicleState& state, double height_m);
  /// Sinks at 1 m/s, .4 m/s below 1 m, then turns the rotors off: idle.
  void land(const VehicleState& state);
  void hold(const VehicleState& state);
  void fly_velocity(const Vec3& v_WB, double yaw_rad);
  /// Between set-points the last one is extrapolated; after 1 s without one it holds (PX4's
  /// off-board loss).
  void follow(const Setpoint& setpoint);

  /// Rotor speeds for the next step. `total_mass_kg` is what it believes to carry.
  [[nodiscard]] RotorSpeeds update(const VehicleState& state, double total_mass_kg, MissionTime now, double dt_s);
  [[nodiscard]] FlightMode mode() const;
  /// Take-off: within .1 m of its height and slow. Land: rotors off.
  [[nodiscard]] bool is_done(const VehicleState& state) const;

 private:
  struct Gains {
    double position{2.0};        ///< 1/s
    double velocity{4.0};        ///< 1/s
    double velocity_integral{0.6};
    double attitude{12.0};       ///< 1/s
    double rate{28.0};           ///< 1/s
    double yaw{3.0};             ///< 1/s
    double max_tilt_rad{0.75};
    double max_yaw_rate_rad_s{1.5707963267948966};
  };
  [[nodiscard]] Setpoint target(const VehicleState& state, MissionTime now, double dt_s);
  [[nodiscard]] RotorSpeeds mix(double thrust_n, const Vec3& torque_B) const;

  Airframe airframe_;
  double ground_z_m_;
  Gains gains_{};
  FlightMode mode_{FlightMode::idle};
  Setpoint setpoint_{};
  double goal_height_m_{};
  Vec3 velocity_error_sum_{Vec3::Zero()};
};

}  // namespace flyball
