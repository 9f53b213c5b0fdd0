// SPDX-License-Identifier: BSD-3-Clause
// tested-in: vehicle
#include "vehicle/gimballed_body.h"

namespace flyball {
namespace {

/// Places in q and u. Free joint: q = quaternion (w, x, y, z) and position, u = angular and linear
/// velocity in W; then the gimbal's three.
constexpr int first_joint_q = 7;
constexpr int first_joint_u = 6;

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

/// What a body feels beside gravity, for Simbody. Borrows its arguments.
class BodyForce final : public SimTK::Force::Custom::Implementation {
 public:
  BodyForce(const SimTK::MobilizedBody& body, const Shape& shape, Loads& loads)
      : body_{body}, shape_{shape}, loads_{loads} {}

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& /*particle_forces*/,
                 SimTK::Vector& /*mobility_forces*/) const override {
    const SimTK::SpatialVec pushed =
        push(body_.getBodyTransform(state), body_.getBodyVelocity(state), shape_, loads_);
    body_.applyBodyForce(state, pushed, body_forces);
  }
  /// Gravity's is counted by the vehicle; the legs' springs count as contact.
  [[nodiscard]] SimTK::Real calcPotentialEnergy(const SimTK::State& /*state*/) const override {
    return 0.0;
  }

 private:
  const SimTK::MobilizedBody& body_;
  const Shape& shape_;
  Loads& loads_;
};

GimbalJoints joints_of(const SimTK::Vector& values, int first) {
  return {values[first], values[first + 1], values[first + 2]};
}

void set_joints(SimTK::Vector& values, int first, const GimbalJoints& joints) {
  values[first] = joints.pan;
  values[first + 1] = joints.roll;
  values[first + 2] = joints.tilt;
}

SimTK::SpatialVec spatial(const SimTK::Vector& u) {
  return {SimTK::Vec3{u[0], u[1], u[2]}, SimTK::Vec3{u[3], u[4], u[5]}};
}

}  // namespace

GimballedBody::GimballedBody(const Build& build, const Shape& shape, Loads& loads)
    : body_{matter_.Ground(), SimTK::Transform{}, SimTK::Body::Rigid{build.body()},
            SimTK::Transform{}},
      lift_drag_contact_{forces_, new BodyForce{body_, shape, loads}} {  // Simbody owns it.
  // Simbody's gimbal turns about its x axis, then y, then z: here about the body's z, x and y.
  const SimTK::Rotation joint{SimTK::UnitVec3{SimTK::ZAxis}, SimTK::XAxis,
                              SimTK::UnitVec3{SimTK::XAxis}, SimTK::YAxis};
  const SimTK::Vec3 below{0.0, 0.0, -0.5 * build.airframe.body_size_m.z() - build.gimbal->radius_m};
  camera_ = {body_, SimTK::Transform{joint, below}, ball(*build.gimbal), SimTK::Transform{joint}};
  // Simbody owns the motors, too.
  const SimTK::Motion::Custom motors{camera_, new JointMotors{joint_acceleration_rad_s2_}};
  state_ = system_.realizeTopology();
  system_.realizeModel(state_);
}

BodyMotion GimballedBody::motion() const {
  const SimTK::Vector& q = state_.getQ();
  return {{q[0], q[1], q[2], q[3]}, {q[4], q[5], q[6]}, spatial(state_.getU())};
}

void GimballedBody::place(const BodyMotion& motion) {
  SimTK::Vector& q = state_.updQ();
  SimTK::Vector& u = state_.updU();
  for (int i = 0; i < 4; ++i) {
    q[i] = motion.attitude[i];
  }
  for (int i = 0; i < 3; ++i) {
    q[4 + i] = motion.p_WB[i];
    u[i] = motion.V_WB[0][i];
    u[3 + i] = motion.V_WB[1][i];
  }
}

MotionStep GimballedBody::step(double dt_s) {
  system_.realize(state_, SimTK::Stage::Acceleration);
  udot_ = state_.getUDot();
  matter_.findMotionForces(state_, motors_);
  SimTK::Vector& u = state_.updU();
  mean_.resize(u.size());
  for (int i = 0; i < u.size(); ++i) {
    const double before = u[i];
    u[i] += dt_s * udot_[i];
    mean_[i] = 0.5 * (before + u[i]);
  }
  matter_.multiplyByN(state_, false, state_.getU(), qdot_);
  state_.updQ() += dt_s * qdot_;
  matter_.normalizeQuaternions(state_);
  // Simbody's sign of the motors' torques: against the motion.
  return {spatial(udot_), spatial(mean_), -dt_s * (~motors_ * mean_)};
}

double GimballedBody::kinetic_j() const {
  system_.realize(state_, SimTK::Stage::Velocity);
  return matter_.calcKineticEnergy(state_);
}

SimTK::Vec3 GimballedBody::centre_of_mass_W() const {
  system_.realize(state_, SimTK::Stage::Position);
  return matter_.calcSystemMassCenterLocationInGround(state_);
}

GimbalJoints GimballedBody::joints() const {
  return joints_of(state_.getQ(), first_joint_q);
}

GimbalJoints GimballedBody::joint_rates() const {
  return joints_of(state_.getU(), first_joint_u);
}

void GimballedBody::place_joints(const GimbalJoints& angles, const GimbalJoints& rates) {
  set_joints(state_.updQ(), first_joint_q, angles);
  set_joints(state_.updU(), first_joint_u, rates);
}

SimTK::Transform GimballedBody::camera_X_W() const {
  system_.realize(state_, SimTK::Stage::Position);
  return camera_.getBodyTransform(state_);
}

}  // namespace flyball
