// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A vehicle without moving parts: Newton's and Euler's equations of one rigid body.

#include "vehicle/vehicle_dynamics.h"

namespace flyball {

/// In closed form: most vehicles are this, and a general multibody system spends most of a step on
/// finding its way through its own caches. The scheme is that of `GimballedBody`.
class FreeBody final : public VehicleDynamics {
 public:
  /// Borrows shape and loads.
  FreeBody(const Build& build, const Shape& shape, Loads& loads);

  [[nodiscard]] BodyMotion motion() const override { return now_; }
  void place(const BodyMotion& motion) override { now_ = motion; }
  MotionStep step(double dt_s) override;
  [[nodiscard]] double kinetic_j() const override;
  [[nodiscard]] SimTK::Vec3 centre_of_mass_W() const override;

 private:
  [[nodiscard]] SimTK::Rotation R_WB() const;
  [[nodiscard]] SimTK::SpatialVec acceleration();

  const Shape& shape_;
  Loads& loads_;
  double mass_kg_;
  SimTK::Vec3 centre_B_;
  SimTK::Mat33 inertia_B_;  ///< About the centre of mass [kg m^2].
  SimTK::Mat33 inverse_inertia_B_;
  BodyMotion now_{};
};

}  // namespace flyball
