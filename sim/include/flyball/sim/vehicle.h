// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The vehicle: a rigid body, four rotors with first-order lag, drag and ground contact; with a
/// camera on a gimbal it is a multibody system of Simbody's.

#include "flyball/runtime/geometry.h"
#include "flyball/sim/airframe.h"
#include "flyball/sim/gimbal.h"

#include <array>
#include <memory>
#include <optional>

namespace flyball {

struct VehicleState {
  Pose X_WB{Pose::Identity()};
  Vec3 v_WB{Vec3::Zero()};
  Vec3 w_WB_B{Vec3::Zero()};  ///< Angular velocity in B [rad/s].
  Vec3 a_WB{Vec3::Zero()};    ///< Of the last step [m/s^2].
  std::array<double, 4> rotor_rev_s{};
};

/// Rotors: 0 front left, 1 front right, 2 rear right, 3 rear left (X layout); 0 and 2 turn
/// clockwise seen from above, so they push the body anticlockwise.
using RotorSpeeds = std::array<double, 4>;  ///< Commanded, rev/s.

/// Where a vehicle begins.
struct VehicleStart {
  Vec3 p_WB{Vec3::Zero()};
  double yaw_rad{};
  double ground_z_m{};  ///< Height of the plane that it stands on.
};

class Vehicle {
 public:
  Vehicle(const Airframe& airframe,
          double payload_kg,
          const VehicleStart& start,
          const std::optional<GimbalSpec>& gimbal = std::nullopt);
  ~Vehicle();
  Vehicle(const Vehicle&) = delete;
  Vehicle& operator=(const Vehicle&) = delete;

  /// One semi-explicit Euler step. @pre `dt_s > 0`; command and wind are finite.
  void step(double dt_s, const RotorSpeeds& command, const Vec3& wind_W);
  /// Instead of a step, for a vehicle that something else moves: it is where `found` says after
  /// `dt_s`, and its gimbal has gone on looking where it was told. No work is counted.
  /// @pre `dt_s >= 0`; `found` is finite, and its rotation is one.
  void place(double dt_s, const VehicleState& found);
  [[nodiscard]] const VehicleState& state() const;
  /// Mass changes at once, motion goes on (the payload leaves at rest relative to the body).
  void set_payload(double payload_kg);
  [[nodiscard]] double mass_kg() const;
  /// Beyond the bare airframe: payload and gimbal.
  [[nodiscard]] double carried_kg() const;

  /// Tells the gimbal where to look. Nothing without one.
  void aim(const GimbalAngles& command);
  [[nodiscard]] GimbalJoints gimbal_joints() const;  ///< [rad]
  /// X_WC of the gimbal's camera (x right, y down, z forward). @pre It has a gimbal.
  [[nodiscard]] Pose camera_pose() const;

  /// Since construction [J]: work of the rotors' thrust and torque on the body, and work against
  /// drag and ground. For the energy balance.
  [[nodiscard]] double rotor_work_j() const;
  [[nodiscard]] double drag_loss_j() const;
  [[nodiscard]] double contact_loss_j() const;
  [[nodiscard]] double gimbal_work_j() const;  ///< Of its motors, on camera and body.
  [[nodiscard]] double kinetic_j() const;
  [[nodiscard]] double potential_j() const;
  /// Mechanical power at the shafts, sum of C_P rho n^3 D^5 [W].
  [[nodiscard]] double shaft_power_w() const;

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace flyball
