// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/vehicle.h"

#include "flyball/runtime/assert.h"

#include "vehicle/vehicle_system.h"
#include <algorithm>
#include <cmath>

#include <Simbody.h>

namespace flyball {
namespace {

constexpr double contact_step_s = 0.001;  // the stiff contact bounds the step, flight does not
}  // namespace

struct Vehicle::Body {
  Build made_of;
  Shape shape;
  Loads loads;
  std::unique_ptr<VehicleSystem> physics;
  GimbalServo servo;
  VehicleState seen;
  double gimbal_work_j{};
  double rotor_work_j{};
  double drag_loss_j{};
  double contact_loss_j{};
  double lag_step_s{};  ///< The step that `lag_kept` is for.
  double lag_kept{};    ///< exp(-dt / tau)

  Body(const Build& of, double ground_z_m)
      : made_of{of},
        shape{shape_of(of.airframe, ground_z_m)},
        loads{},
        servo{of.gimbal.value_or(GimbalSpec{})} {
    build();
  }

  void build() { physics = std::make_unique<VehicleSystem>(made_of, shape, loads); }
  [[nodiscard]] GimbalJoints joints(const SimTK::Vector& values, int first) const {
    return made_of.gimbal ? GimbalJoints{values[first], values[first + 1], values[first + 2]}
                          : GimbalJoints{};
  }

  void turn_rotors(double dt_s, const RotorSpeeds& command);
  void turn_camera(double dt_s);
  /// Room for what a step computes, so that none allocates.
  struct Steps {
    SimTK::Vector udot{};
    SimTK::Vector motors{};  ///< Of the gimbal.
    SimTK::Vector mean{};
    SimTK::Vector qdot{};
  };
  Steps steps{};

  void integrate(double dt_s);
  void turn_and_move(double dt_s);
  void read_state(const SimTK::Vec3& a_WB);
};

/// First-order lag, exact for a constant command; thrust and torque follow from the mean of n^2
/// over the step, so the impulse of a spin-up does not depend on the step.
void Vehicle::Body::turn_rotors(double dt_s, const RotorSpeeds& command) {
  const Airframe& airframe = made_of.airframe;
  const double tau_s = airframe.rotor_lag_s;
  if (dt_s != lag_step_s) {
    lag_step_s = dt_s;
    lag_kept = std::exp(-dt_s / tau_s);
  }
  const double mean_1 = tau_s / dt_s * (1.0 - lag_kept);
  const double mean_2 = 0.5 * tau_s / dt_s * (1.0 - lag_kept * lag_kept);
  const double thrust_per_n2 = airframe.thrust_per_n2();
  double signed_n2 = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double& n = seen.rotor_rev_s[i];
    const double goal = std::clamp(command[i], 0.0, airframe.max_rotor_rev_s());
    const double gap = n - goal;
    const double n2 = goal * goal + 2.0 * goal * gap * mean_1 + gap * gap * mean_2;
    n = goal + gap * lag_kept;
    loads.thrust_n[i] = thrust_per_n2 * n2;
    signed_n2 +=
        (i % 2 == 0 ? n2 : -n2);  // 0 and 2 turn clockwise and push the body anticlockwise.
  }
  // The rotors' own angular momentum is neglected: .055 kg of motor and blades against the
  // airframe.
  loads.reaction_nm = airframe.torque_per_n2() * signed_n2;
}

void Vehicle::Body::turn_camera(double dt_s) {
  if (made_of.gimbal) {
    const SimTK::State& state = physics->state;
    servo.slew(dt_s);
    physics->joint_acceleration_rad_s2 =
        servo.acceleration(seen.X_WB.linear(), joints(state.getQ(), first_joint_q),
                           joints(state.getU(), first_joint_u));
  }
}

void Vehicle::Body::integrate(double dt_s) {
  SimTK::State& state = physics->state;
  physics->system.realize(state, SimTK::Stage::Acceleration);
  Steps& step = steps;
  step.udot = state.getUDot();
  if (made_of.gimbal) {
    physics->matter.findMotionForces(state, step.motors);
  }
  // Work at the mean speed of the step: with it a force's work is exactly the kinetic energy that
  // this scheme gives a mass.
  SimTK::Vector& mean = step.mean;
  SimTK::Vector& u = state.updU();
  mean.resize(u.size());
  for (int i = 0; i < u.size(); ++i) {
    const double before = u[i];
    u[i] += dt_s * step.udot[i];
    mean[i] = 0.5 * (before + u[i]);
  }
  const SimTK::SpatialVec V_mean{SimTK::Vec3{mean[0], mean[1], mean[2]},
                                 SimTK::Vec3{mean[3], mean[4], mean[5]}};
  rotor_work_j += dt_s * (~loads.rotors * V_mean);
  drag_loss_j -= dt_s * (~loads.drag * V_mean);
  contact_loss_j -= dt_s * (~loads.contact * V_mean);
  if (made_of.gimbal) {
    gimbal_work_j -= dt_s * (~step.motors * mean);  // Simbody's sign: against the motion.
  }
  turn_and_move(dt_s);
  read_state(SimTK::Vec3{step.udot[3], step.udot[4], step.udot[5]});
}

/// With the speeds that the step ends with. What Simbody's matter does for all joints is done here
/// for the free one alone: there it looks up every cache of the state, at each call.
void Vehicle::Body::turn_and_move(double dt_s) {
  SimTK::State& state = physics->state;
  if (made_of.gimbal) {
    physics->matter.multiplyByN(state, false, state.getU(), steps.qdot);
    state.updQ() += dt_s * steps.qdot;
    physics->matter.normalizeQuaternions(state);
    return;
  }
  const SimTK::Vector& u = state.getU();
  SimTK::Vector& q = state.updQ();
  SimTK::Vec4 attitude{q[0], q[1], q[2], q[3]};
  const SimTK::Vec4 turn =
      SimTK::Rotation::calcUnnormalizedNForQuaternion(attitude) * SimTK::Vec3{u[0], u[1], u[2]};
  attitude += dt_s * turn;
  attitude = attitude / attitude.norm();
  for (int i = 0; i < 4; ++i) {
    q[i] = attitude[i];
  }
  for (int i = 0; i < 3; ++i) {
    q[4 + i] += dt_s * u[3 + i];
  }
}

void Vehicle::Body::read_state(const SimTK::Vec3& a_WB) {
  const SimTK::Vector& q = physics->state.getQ();
  const SimTK::Vector& u = physics->state.getU();
  const Eigen::Matrix3d R_WB = Eigen::Quaterniond{q[0], q[1], q[2], q[3]}.toRotationMatrix();
  seen.X_WB.linear() = R_WB;
  seen.X_WB.translation() = Vec3{q[4], q[5], q[6]};
  seen.w_WB_B = R_WB.transpose() * Vec3{u[0], u[1], u[2]};
  seen.v_WB = Vec3{u[3], u[4], u[5]};
  seen.a_WB = Vec3{a_WB[0], a_WB[1], a_WB[2]};
}

Vehicle::Vehicle(const Airframe& airframe,
                 double payload_kg,
                 const VehicleStart& start,
                 const std::optional<GimbalSpec>& gimbal) {
  FLYBALL_ASSERT(airframe.validate().empty(), "%s", airframe.validate().front().message.c_str());
  FLYBALL_ASSERT(payload_kg >= 0.0, "payload_kg=%g", payload_kg);
  body_ = std::make_unique<Body>(Build{airframe, payload_kg, gimbal}, start.ground_z_m);
  SimTK::Vector& q = body_->physics->state.updQ();
  q[0] = std::cos(0.5 * start.yaw_rad);
  q[1] = 0.0;
  q[2] = 0.0;
  q[3] = std::sin(0.5 * start.yaw_rad);
  for (int i = 0; i < 3; ++i) {
    q[4 + i] = start.p_WB[i];
  }
  body_->read_state(SimTK::Vec3{0.0});
}

Vehicle::~Vehicle() = default;

void Vehicle::step(double dt_s, const RotorSpeeds& command, const Vec3& wind_W) {
  FLYBALL_ASSERT(dt_s > 0.0, "dt_s=%g", dt_s);
  const double sum = command[0] + command[1] + command[2] + command[3] + wind_W.sum();
  FLYBALL_ASSERT(std::isfinite(sum), "a rotor command or the wind is not finite: sum=%g", sum);
  body_->loads.wind_W = wind_W;
  // Wider than the body is high: no foot of a tilted vehicle reaches the ground from above this.
  const Airframe& airframe = body_->made_of.airframe;
  const double reach_m = airframe.body_height_m + airframe.arm_m;
  const bool may_touch = body_->seen.X_WB.translation().z() - body_->shape.ground_z_m < reach_m;
  const int parts =
      may_touch ? std::max(1, static_cast<int>(std::ceil(dt_s / contact_step_s - 1e-9))) : 1;
  for (int i = 0; i < parts; ++i) {
    body_->turn_rotors(dt_s / parts, command);
    body_->turn_camera(dt_s / parts);
    body_->integrate(dt_s / parts);
  }
}

const VehicleState& Vehicle::state() const {
  return body_->seen;
}

void Vehicle::set_payload(double payload_kg) {
  FLYBALL_ASSERT(payload_kg >= 0.0, "payload_kg=%g", payload_kg);
  const SimTK::Vector q = body_->physics->state.getQ();
  const SimTK::Vector u = body_->physics->state.getU();
  body_->made_of.payload_kg = payload_kg;
  body_->build();
  body_->physics->state.updQ() = q;
  body_->physics->state.updU() = u;
}

double Vehicle::payload_kg() const {
  return body_->made_of.payload_kg;
}
double Vehicle::mass_kg() const {
  return body_->made_of.mass_kg();
}
double Vehicle::carried_kg() const {
  return body_->made_of.payload_kg + body_->made_of.gimbal_kg();
}
double Vehicle::rotor_work_j() const {
  return body_->rotor_work_j;
}
double Vehicle::drag_loss_j() const {
  return body_->drag_loss_j;
}
double Vehicle::contact_loss_j() const {
  return body_->contact_loss_j;
}

double Vehicle::gimbal_work_j() const {
  return body_->gimbal_work_j;
}

void Vehicle::aim(const GimbalAngles& command) {
  body_->servo.aim(command);
}

GimbalJoints Vehicle::gimbal_joints() const {
  return body_->joints(body_->physics->state.getQ(), first_joint_q);
}

Pose Vehicle::camera_pose() const {
  FLYBALL_ASSERT(body_->made_of.gimbal, "this vehicle has no gimbal");
  const VehicleSystem& physics = *body_->physics;
  physics.system.realize(physics.state, SimTK::Stage::Position);
  const SimTK::Transform& X = physics.camera.getBodyTransform(physics.state);
  Pose X_WG = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    X_WG.translation()[i] = X.p()[i];
    for (int k = 0; k < 3; ++k) {
      X_WG.linear()(i, k) = X.R().asMat33()(i, k);
    }
  }
  return X_WG * camera_in_level_frame({});
}

double Vehicle::kinetic_j() const {
  const VehicleSystem& physics = *body_->physics;
  physics.system.realize(physics.state, SimTK::Stage::Velocity);
  return physics.matter.calcKineticEnergy(physics.state);
}

double Vehicle::potential_j() const {
  const VehicleSystem& physics = *body_->physics;
  physics.system.realize(physics.state, SimTK::Stage::Position);
  const SimTK::Vec3 centre_W = physics.matter.calcSystemMassCenterLocationInGround(physics.state);
  return mass_kg() * gravity_m_s2 * (centre_W[2] - body_->shape.ground_z_m);
}

double Vehicle::shaft_power_w() const {
  double sum_n3 = 0.0;
  for (const double n : body_->seen.rotor_rev_s) {
    sum_n3 += n * n * n;
  }
  return body_->made_of.airframe.power_per_n3() * sum_n3;
}

}  // namespace flyball
