// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A vehicle with a camera on three pins, as a multibody system of Simbody's. Only for .cpp files.

#include "vehicle/vehicle_dynamics.h"

namespace flyball {

class GimballedBody final : public VehicleDynamics {
 public:
  /// Borrows shape and loads. @pre The build has a gimbal.
  GimballedBody(const Build& build, const Shape& shape, Loads& loads);

  [[nodiscard]] BodyMotion motion() const override;
  void place(const BodyMotion& motion) override;
  MotionStep step(double dt_s) override;
  [[nodiscard]] double kinetic_j() const override;
  [[nodiscard]] SimTK::Vec3 centre_of_mass_W() const override;

  /// What the gimbal's motors do from now on [rad/s^2].
  void turn_joints(const GimbalJoints& acceleration_rad_s2) {
    joint_acceleration_rad_s2_ = acceleration_rad_s2;
  }
  [[nodiscard]] GimbalJoints joints() const;       ///< [rad]
  [[nodiscard]] GimbalJoints joint_rates() const;  ///< [rad/s]
  void place_joints(const GimbalJoints& angles, const GimbalJoints& rates);
  [[nodiscard]] SimTK::Transform camera_X_W() const;

 private:
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  SimTK::Force::UniformGravity gravity_{forces_, matter_, SimTK::Vec3{0.0, 0.0, -gravity_m_s2}};
  SimTK::MobilizedBody::Free body_;
  SimTK::Force::Custom lift_drag_contact_;
  SimTK::MobilizedBody::Gimbal camera_{};
  GimbalJoints joint_acceleration_rad_s2_{};
  SimTK::State state_;

  /// Room for what a step computes, so that none allocates.
  SimTK::Vector udot_{};
  SimTK::Vector motors_{};
  SimTK::Vector mean_{};
  SimTK::Vector qdot_{};
};

}  // namespace flyball
