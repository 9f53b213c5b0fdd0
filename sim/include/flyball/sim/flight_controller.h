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

  /// Climbs at 1.5 m/s over the present place until its centre is `height_m` above the ground, then
  /// holds there.
  void take_off(const VehicleState& state, double height_m);
  /// Sinks at 1 m/s, .4 m/s below 1 m, then turns the rotors off: idle.
  void land(const VehicleState& state);
  /// Stops along the present velocity, then stays.
  void hold(const VehicleState& state);
  void fly_velocity(const Vec3& v_WB, double yaw_rad);
  /// Between set-points the last one is extrapolated, a braking one to its stop; after 1 s without
  /// one it holds (PX4's off-board loss).
  void follow(const Setpoint& setpoint);

  /// Rotor speeds for the next step, good for `dt_s` of .5 to 10 ms. `total_mass_kg` is what it
  /// believes to carry; a wrong belief is corrected within a second, as is wind.
  [[nodiscard]] RotorSpeeds update(const VehicleState& state,
                                   double total_mass_kg,
                                   MissionTime now,
                                   double dt_s);
  [[nodiscard]] FlightMode mode() const { return mode_; }
  /// Take-off: within .1 m of its height and slow. Hold: slow. Land: rotors off. Else false.
  [[nodiscard]] bool is_done(const VehicleState& state) const;

 private:
  /// Tuned on the Matrice 100, see tests/sim/flight_controller_test.cpp; the angular ones are rates
  /// of a closed loop, so they fit any airframe whose rotors are as quick.
  struct Gains {
    double position{2.5};       ///< 1/s
    double velocity{5.0};       ///< 1/s
    double height{5.0};         ///< 1/s: thrust answers sooner than tilt, so the vertical loop is
    double climb{12.0};         ///< 1/s: stiffer than the level one
    double disturbance_s{0.3};  ///< Time constant of the wind and mass observer.
    double attitude{15.0};      ///< 1/s
    double rate{35.0};          ///< 1/s
    double yaw{3.0};            ///< 1/s
    double yaw_rate{8.0};       ///< 1/s: reaction torque is weak, so slower than `rate`
    double rotor_s{0.012};      ///< Time constant that the commands' lead makes of the rotors'.
    double max_tilt_rad{0.75};
    double max_yaw_rate_rad_s{1.5707963267948966};
    double max_yaw_acceleration_rad_s2{4.0};
  };
  [[nodiscard]] Setpoint target(const VehicleState& state, MissionTime now, double dt_s);
  void start_reference(const VehicleState& state);
  void sink(const VehicleState& state, double dt_s);
  void slew_velocity(double dt_s);
  void slew_yaw(const Setpoint& wanted, double dt_s);
  void observe(const VehicleState& state, double total_mass_kg, double dt_s);
  [[nodiscard]] Vec3 specific_force(const VehicleState& state, const Setpoint& wanted) const;
  [[nodiscard]] Vec3 torque(const VehicleState& state, const Vec3& force_W) const;
  [[nodiscard]] RotorSpeeds mix(double thrust_n, const Vec3& torque_B) const;
  /// Of the lowest foot: in wind the vehicle tilts, and comes down on one of them.
  [[nodiscard]] double feet_height_m(const VehicleState& state) const;

  Airframe airframe_;
  double ground_z_m_;
  Gains gains_{};
  FlightMode mode_{FlightMode::idle};
  Setpoint setpoint_{};   ///< The newest of `follow`.
  Setpoint reference_{};  ///< Of the modes that make their own.
  bool reference_is_fresh_{false};
  Vec3 goal_velocity_{Vec3::Zero()};
  double goal_height_m_{};
  double yaw_rad_{};  ///< Reference within the rate limit.
  double yaw_rate_rad_s_{};
  double yaw_acceleration_rad_s2_{};
  double touching_s_{};
  Vec3 disturbance_{
      Vec3::Zero()};  ///< What accelerates the vehicle beside thrust and gravity [m/s^2].
};

}  // namespace flyball
