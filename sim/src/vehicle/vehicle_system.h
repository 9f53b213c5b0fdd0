// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The vehicle as a multibody system of Simbody's: a free body, and a camera on three pins if it
/// has a gimbal. Only for .cpp files.

#include "flyball/sim/gimbal.h"

#include "vehicle/vehicle_forces.h"
#include <memory>
#include <optional>

namespace flyball {

/// What a vehicle is made of.
struct Build {
  Airframe airframe{};
  double payload_kg{};
  std::optional<GimbalSpec> gimbal{};

  [[nodiscard]] double gimbal_kg() const { return gimbal ? gimbal->mass_kg : 0.0; }
  [[nodiscard]] double mass_kg() const { return airframe.mass_kg + payload_kg + gimbal_kg(); }
};

/// Places in q and u. Free joint: q = quaternion (w, x, y, z) and position, u = angular and linear
/// velocity in W; then the gimbal's three.
constexpr int first_joint_q = 7;
constexpr int first_joint_u = 6;

/// One build of the system; a new mass needs a new one.
struct VehicleSystem {
  /// Borrows shape and loads.
  VehicleSystem(const Build& build, const Shape& shape, Loads& loads);

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::UniformGravity gravity{forces, matter, SimTK::Vec3{0.0, 0.0, -gravity_m_s2}};
  SimTK::MobilizedBody::Free body;
  SimTK::Force::Custom lift_drag_contact;
  SimTK::MobilizedBody::Gimbal camera{};     ///< Empty without a gimbal.
  GimbalJoints joint_acceleration_rad_s2{};  ///< What the gimbal's motors are to do.
  SimTK::State state;
};

}  // namespace flyball
