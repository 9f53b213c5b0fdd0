// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How a vehicle moves under its loads. Only for .cpp files.

#include "flyball/sim/gimbal.h"

#include "vehicle/vehicle_forces.h"
#include <optional>

namespace flyball {

/// What a vehicle is made of.
struct Build {
  Airframe airframe{};
  double payload_kg{};
  std::optional<GimbalSpec> gimbal{};

  [[nodiscard]] double gimbal_kg() const { return gimbal ? gimbal->mass_kg : 0.0; }
  [[nodiscard]] double mass_kg() const { return airframe.mass_kg + payload_kg + gimbal_kg(); }
  /// Mass, centre and inertia of airframe and payload, about the body's origin, in B.
  [[nodiscard]] SimTK::MassProperties body() const;
};

/// Where the body is and how fast it moves; the spatial velocity is (angular, linear) in W.
struct BodyMotion {
  SimTK::Vec4 attitude{1.0, 0.0, 0.0, 0.0};  ///< Quaternion (w, x, y, z) of R_WB.
  SimTK::Vec3 p_WB{0.0};
  SimTK::SpatialVec V_WB{SimTK::Vec3{0.0}, SimTK::Vec3{0.0}};
};

/// What a step did to the body. A force's work at the mean velocity is exactly the kinetic energy
/// that semi-explicit Euler gives a mass.
struct MotionStep {
  SimTK::SpatialVec A_WB{};
  SimTK::SpatialVec V_mean{};
  double gimbal_work_j{};
};

/// A body that flies: alone (`FreeBody`), or with a camera on a gimbal (`GimballedBody`).
class VehicleDynamics {
 public:
  VehicleDynamics() = default;
  virtual ~VehicleDynamics() = default;
  VehicleDynamics(const VehicleDynamics&) = delete;
  VehicleDynamics& operator=(const VehicleDynamics&) = delete;

  [[nodiscard]] virtual BodyMotion motion() const = 0;
  virtual void place(const BodyMotion& motion) = 0;
  /// One semi-explicit Euler step; sets the wrenches of the loads.
  virtual MotionStep step(double dt_s) = 0;
  /// Of all that flies.
  [[nodiscard]] virtual double kinetic_j() const = 0;
  [[nodiscard]] virtual SimTK::Vec3 centre_of_mass_W() const = 0;
};

}  // namespace flyball
