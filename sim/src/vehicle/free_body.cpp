// SPDX-License-Identifier: BSD-3-Clause
// tested-in: vehicle
#include "vehicle/free_body.h"

namespace flyball {

FreeBody::FreeBody(const Build& build, const Shape& shape, Loads& loads)
    : shape_{shape}, loads_{loads} {
  const SimTK::MassProperties body = build.body();
  mass_kg_ = body.getMass();
  centre_B_ = body.getMassCenter();
  inertia_B_ = body.calcCentralInertia().toMat33();
  inverse_inertia_B_ = inertia_B_.invert();
}

SimTK::Rotation FreeBody::R_WB() const {
  return SimTK::Rotation{SimTK::Quaternion{now_.attitude, true}};  // It has the length 1.
}

/// Euler's equation about the centre of mass, in B, where the inertia is constant; then the
/// acceleration of the body's origin from that of the centre.
SimTK::SpatialVec FreeBody::acceleration() {
  const SimTK::Rotation R = R_WB();
  const SimTK::SpatialVec pushed =
      push({R, now_.p_WB}, now_.V_WB, shape_, loads_);  // About the origin.
  const SimTK::Vec3 centre = R * centre_B_;
  const SimTK::Vec3 w_B = ~R * now_.V_WB[0];
  const SimTK::Vec3 torque_B = ~R * (pushed[0] - centre % pushed[1]);
  const SimTK::Vec3 turn = R * (inverse_inertia_B_ * (torque_B - w_B % (inertia_B_ * w_B)));
  const SimTK::Vec3& w = now_.V_WB[0];
  const SimTK::Vec3 gravity{0.0, 0.0, -gravity_m_s2};
  return {turn, pushed[1] / mass_kg_ + gravity - turn % centre - w % (w % centre)};
}

MotionStep FreeBody::step(double dt_s) {
  const SimTK::SpatialVec before = now_.V_WB;
  MotionStep done;
  done.A_WB = acceleration();
  now_.V_WB += dt_s * done.A_WB;
  done.V_mean = 0.5 * (before + now_.V_WB);
  now_.attitude +=
      dt_s * (SimTK::Rotation::calcUnnormalizedNForQuaternion(now_.attitude) * now_.V_WB[0]);
  now_.attitude = now_.attitude / now_.attitude.norm();
  now_.p_WB += dt_s * now_.V_WB[1];
  return done;
}

double FreeBody::kinetic_j() const {
  const SimTK::Rotation R = R_WB();
  const SimTK::Vec3 w_B = ~R * now_.V_WB[0];
  const SimTK::Vec3 v = now_.V_WB[1] + now_.V_WB[0] % (R * centre_B_);
  return 0.5 * (mass_kg_ * (~v * v) + ~w_B * (inertia_B_ * w_B));
}

SimTK::Vec3 FreeBody::centre_of_mass_W() const {
  return now_.p_WB + R_WB() * centre_B_;
}

}  // namespace flyball
