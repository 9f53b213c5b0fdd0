// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What pushes the vehicle: rotors, drag and the ground.

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

/// All that pushes the body but gravity, at this pose and velocity: sets the wrenches of `loads`,
/// and returns their sum.
SimTK::SpatialVec push(const SimTK::Transform& X_WB,
                       const SimTK::SpatialVec& V_WB,
                       const Shape& shape,
                       Loads& loads);

}  // namespace flyball
