// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What pushes the multibody vehicle: rotors, drag and the ground.

#include "flyball/sim/airframe.h"

#include <array>

#include <Simbody.h>

namespace flyball {

/// What acts on the body now, and the shares of it that the energy balance needs. Wrenches are
/// about the body's origin, in W.
struct Loads {
  std::array<double, 4> thrust_n{};
  double reaction_nm{};  ///< About the body's z axis.
  Vec3 wind_W{Vec3::Zero()};
  SimTK::SpatialVec rotors{};
  SimTK::SpatialVec drag{};
  SimTK::SpatialVec contact{};
};

/// What the loads depend on and does not change in flight.
struct Shape {
  std::array<SimTK::Vec3, 4> rotors_B;
  std::array<SimTK::Vec3, 4> feet_B;
  double drag_factor{};  ///< rho c_d A / 2
  double ground_z_m{};
  double stiffness_n_m{};  ///< Of one foot.
  double damping_n_s_m{};
};

[[nodiscard]] Shape shape_of(const Airframe& airframe, double ground_z_m);

/// All forces but gravity. Borrows its arguments; writes the wrenches of `loads`.
class BodyForce final : public SimTK::Force::Custom::Implementation {
 public:
  BodyForce(const SimTK::MobilizedBody& body, const Shape& shape, Loads& loads)
      : body_{body}, shape_{shape}, loads_{loads} {}

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& particle_forces,
                 SimTK::Vector& mobility_forces) const override;
  /// Gravity's is counted by the vehicle; the legs' springs count as contact.
  [[nodiscard]] SimTK::Real calcPotentialEnergy(const SimTK::State& /*state*/) const override {
    return 0.0;
  }

 private:
  [[nodiscard]] SimTK::SpatialVec rotors(const SimTK::Rotation& R_WB) const;
  [[nodiscard]] SimTK::SpatialVec drag(const SimTK::Vec3& v_WB) const;
  [[nodiscard]] SimTK::SpatialVec contact(const SimTK::Transform& X_WB,
                                          const SimTK::SpatialVec& V_WB) const;

  const SimTK::MobilizedBody& body_;
  const Shape& shape_;
  Loads& loads_;
};

}  // namespace flyball
