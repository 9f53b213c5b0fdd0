// SPDX-License-Identifier: BSD-3-Clause
// tested-in: vehicle

#include "vehicle/vehicle_forces.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// The ground: own choices. Flight does not depend on them, landing gently does little.
constexpr double sink_at_rest_m = 0.002;       // of the bare airframe: gives the stiffness
constexpr double contact_damping_ratio = 0.7;  // no second bounce
constexpr double friction = 0.6;
// Slower than this, friction is viscous instead of Coulomb's, so that Euler's steps stay stable.
constexpr double friction_slip_m_s = 0.05;

SimTK::Vec3 simtk(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

SimTK::SpatialVec of_rotors(const SimTK::Rotation& R_WB, const Shape& shape, const Loads& loads) {
  SimTK::Vec3 torque_B{0.0, 0.0, loads.reaction_nm};
  double thrust_n = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double t = loads.thrust_n[i];
    thrust_n += t;
    torque_B += shape.rotors_B[i] % SimTK::Vec3{0.0, 0.0, t};
  }
  return {R_WB * torque_B, thrust_n * SimTK::Vec3{R_WB.z()}};
}

SimTK::SpatialVec of_drag(const SimTK::Vec3& v_WB, const Shape& shape, const Loads& loads) {
  const SimTK::Vec3 airspeed = v_WB - simtk(loads.wind_W);
  return {SimTK::Vec3{0.0}, -shape.drag_factor * airspeed.norm() * airspeed};
}

SimTK::SpatialVec of_contact(const SimTK::Transform& X_WB,
                             const SimTK::SpatialVec& V_WB,
                             const Shape& shape) {
  SimTK::SpatialVec sum{SimTK::Vec3{0.0}, SimTK::Vec3{0.0}};
  for (const SimTK::Vec3& foot_B : shape.feet_B) {
    const SimTK::Vec3 arm = X_WB.R() * foot_B;
    const double sink_m = shape.ground_z_m - (X_WB.p()[2] + arm[2]);
    if (sink_m <= 0.0) {
      continue;
    }
    const SimTK::Vec3 v = V_WB[1] + V_WB[0] % arm;
    const double normal_n =
        std::max(0.0, shape.stiffness_n_m * sink_m - shape.damping_n_s_m * v[2]);
    const double slip_m_s = std::max(friction_slip_m_s, std::hypot(v[0], v[1]));
    const double grip = friction * normal_n / slip_m_s;
    const SimTK::Vec3 force{-grip * v[0], -grip * v[1], normal_n};
    sum += SimTK::SpatialVec{arm % force, force};
  }
  return sum;
}

}  // namespace

Shape shape_of(const Airframe& airframe, double ground_z_m) {
  Shape shape;
  const auto rotors_B = airframe.rotor_points_B();
  const auto feet_B = airframe.foot_points_B();
  for (std::size_t i = 0; i < 4; ++i) {
    shape.rotors_B[i] = simtk(rotors_B[i]);
    shape.feet_B[i] = simtk(feet_B[i]);
  }
  shape.drag_factor = 0.5 * air_density_kg_m3 * airframe.drag_area_m2;
  shape.ground_z_m = ground_z_m;
  const double share_kg = 0.25 * airframe.mass_kg;
  shape.stiffness_n_m = share_kg * gravity_m_s2 / sink_at_rest_m;
  shape.damping_n_s_m = 2.0 * contact_damping_ratio * std::sqrt(shape.stiffness_n_m * share_kg);
  return shape;
}

SimTK::SpatialVec push(const SimTK::Transform& X_WB,
                       const SimTK::SpatialVec& V_WB,
                       const Shape& shape,
                       Loads& loads) {
  loads.rotors = of_rotors(X_WB.R(), shape, loads);
  loads.drag = of_drag(V_WB[1], shape, loads);
  loads.contact = of_contact(X_WB, V_WB, shape);
  return loads.rotors + loads.drag + loads.contact;
}

}  // namespace flyball
