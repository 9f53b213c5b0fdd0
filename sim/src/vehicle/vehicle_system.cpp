// SPDX-License-Identifier: BSD-3-Clause
// tested-in: vehicle
#include "vehicle/vehicle_system.h"

namespace flyball {
namespace {

constexpr double payload_gap_m = 0.02;  // payload's centre below the body's lower face: own choice

SimTK::Body::Rigid rigid(const Airframe& a, double payload_kg) {
  const SimTK::Vec3 at{0.0, 0.0, -0.5 * a.body_size_m.z() - payload_gap_m};
  const double mass_kg = a.mass_kg + payload_kg;
  const Vec3 inertia = a.inertia_kg_m2();
  const SimTK::Inertia about_origin =
      SimTK::Inertia{inertia.x(), inertia.y(), inertia.z()} + SimTK::Inertia{at, payload_kg};
  return SimTK::Body::Rigid{
      SimTK::MassProperties{mass_kg, (payload_kg / mass_kg) * at, about_origin}};
}

SimTK::Body::Rigid ball(const GimbalSpec& gimbal) {
  const double inertia = 0.4 * gimbal.mass_kg * gimbal.radius_m * gimbal.radius_m;
  return SimTK::Body::Rigid{
      SimTK::MassProperties{gimbal.mass_kg, SimTK::Vec3{0.0}, SimTK::Inertia{inertia}}};
}

/// Motors that turn the joints as they are told; Simbody finds the torques, and the body feels
/// them.
class JointMotors final : public SimTK::Motion::Custom::Implementation {
 public:
  explicit JointMotors(const GimbalJoints& acceleration_rad_s2) : told_{acceleration_rad_s2} {}

  [[nodiscard]] SimTK::Motion::Level getLevel(const SimTK::State& /*state*/) const override {
    return SimTK::Motion::Acceleration;
  }
  void calcPrescribedAcceleration(const SimTK::State& /*state*/,
                                  int /*count*/,
                                  SimTK::Real* udot) const override {
    udot[0] = told_.pan;
    udot[1] = told_.roll;
    udot[2] = told_.tilt;
  }

 private:
  const GimbalJoints& told_;
};

}  // namespace

VehicleSystem::VehicleSystem(const Build& build, const Shape& shape, Loads& loads)
    : body{matter.Ground(), SimTK::Transform{}, rigid(build.airframe, build.payload_kg),
           SimTK::Transform{}},
      lift_drag_contact{forces, new BodyForce{body, shape, loads}} {  // Simbody owns it.
  if (build.gimbal) {
    // Simbody's gimbal turns about its x axis, then y, then z: here about the body's z, x and y.
    const SimTK::Rotation joint{SimTK::UnitVec3{SimTK::ZAxis}, SimTK::XAxis,
                                SimTK::UnitVec3{SimTK::XAxis}, SimTK::YAxis};
    const SimTK::Vec3 below{0.0, 0.0,
                            -0.5 * build.airframe.body_size_m.z() - build.gimbal->radius_m};
    camera = {body, SimTK::Transform{joint, below}, ball(*build.gimbal), SimTK::Transform{joint}};
    SimTK::Motion::Custom{camera, new JointMotors{joint_acceleration_rad_s2}};  // Simbody's, too.
  }
  state = system.realizeTopology();
  system.realizeModel(state);
}

}  // namespace flyball
