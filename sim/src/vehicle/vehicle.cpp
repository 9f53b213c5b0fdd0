// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/vehicle.h"

#include "flyball/runtime/assert.h"

#include "vehicle/free_body.h"
#include "vehicle/gimballed_body.h"
#include <algorithm>
#include <cmath>

#include <Simbody.h>

namespace flyball {
namespace {

constexpr double contact_step_s = 0.001;  // the stiff contact bounds the step, flight does not
constexpr double payload_gap_m = 0.02;  // payload's centre below the body's lower face: own choice

}  // namespace

SimTK::MassProperties Build::body() const {
  const SimTK::Vec3 at{0.0, 0.0, -0.5 * airframe.body_size_m.z() - payload_gap_m};
  const double both_kg = airframe.mass_kg + payload_kg;
  const Vec3 inertia = airframe.inertia_kg_m2();
  const SimTK::Inertia about_origin =
      SimTK::Inertia{inertia.x(), inertia.y(), inertia.z()} + SimTK::Inertia{at, payload_kg};
  return {both_kg, (payload_kg / both_kg) * at, about_origin};
}

struct Vehicle::Body {
  Build made_of;
  Shape shape;
  Loads loads;
  std::unique_ptr<VehicleDynamics> dynamics;
  GimballedBody* gimballed{};  ///< The dynamics, if there is a gimbal.
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

  void build();
  void turn_rotors(double dt_s, const RotorSpeeds& command);
  void turn_camera(double dt_s);
  void turn_placed_camera(double dt_s);
  void integrate(double dt_s);
  void read_state(const SimTK::SpatialVec& A_WB);
};

void Vehicle::Body::build() {
  if (!made_of.gimbal) {
    dynamics = std::make_unique<FreeBody>(made_of, shape, loads);
    return;
  }
  auto with_camera = std::make_unique<GimballedBody>(made_of, shape, loads);
  gimballed = with_camera.get();
  dynamics = std::move(with_camera);
}

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
  if (gimballed != nullptr) {
    servo.slew(dt_s);
    gimballed->turn_joints(
        servo.acceleration(seen.X_WB.linear(), gimballed->joints(), gimballed->joint_rates()));
  }
}

/// Without dynamics the motors turn the joints exactly as they are told.
void Vehicle::Body::turn_placed_camera(double dt_s) {
  if (gimballed == nullptr) {
    return;
  }
  servo.slew(dt_s);
  GimbalJoints joints = gimballed->joints();
  GimbalJoints rates = gimballed->joint_rates();
  const GimbalJoints turned = servo.acceleration(seen.X_WB.linear(), joints, rates);
  rates = {rates.pan + dt_s * turned.pan, rates.roll + dt_s * turned.roll,
           rates.tilt + dt_s * turned.tilt};
  joints = {joints.pan + dt_s * rates.pan, joints.roll + dt_s * rates.roll,
            joints.tilt + dt_s * rates.tilt};
  gimballed->place_joints(joints, rates);
}

void Vehicle::Body::integrate(double dt_s) {
  const MotionStep step = dynamics->step(dt_s);
  rotor_work_j += dt_s * (~loads.rotors * step.V_mean);
  drag_loss_j -= dt_s * (~loads.drag * step.V_mean);
  contact_loss_j -= dt_s * (~loads.contact * step.V_mean);
  gimbal_work_j += step.gimbal_work_j;
  read_state(step.A_WB);
}

void Vehicle::Body::read_state(const SimTK::SpatialVec& A_WB) {
  const BodyMotion now = dynamics->motion();
  const SimTK::Vec4& q = now.attitude;
  const auto eigen = [](const SimTK::Vec3& v) { return Vec3{v[0], v[1], v[2]}; };
  const Eigen::Matrix3d R_WB = Eigen::Quaterniond{q[0], q[1], q[2], q[3]}.toRotationMatrix();
  seen.X_WB.linear() = R_WB;
  seen.X_WB.translation() = eigen(now.p_WB);
  seen.w_WB_B = R_WB.transpose() * eigen(now.V_WB[0]);
  seen.v_WB = eigen(now.V_WB[1]);
  seen.a_WB = eigen(A_WB[1]);
}

Vehicle::Vehicle(const Airframe& airframe,
                 double payload_kg,
                 const VehicleStart& start,
                 const std::optional<GimbalSpec>& gimbal) {
  FLYBALL_ASSERT(airframe.validate().empty(), "%s", airframe.validate().front().message.c_str());
  FLYBALL_ASSERT(payload_kg >= 0.0, "payload_kg=%g", payload_kg);
  body_ = std::make_unique<Body>(Build{airframe, payload_kg, gimbal}, start.ground_z_m);
  BodyMotion motion;
  motion.attitude = {std::cos(0.5 * start.yaw_rad), 0.0, 0.0, std::sin(0.5 * start.yaw_rad)};
  motion.p_WB = {start.p_WB.x(), start.p_WB.y(), start.p_WB.z()};
  body_->dynamics->place(motion);
  body_->read_state({SimTK::Vec3{0.0}, SimTK::Vec3{0.0}});
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

void Vehicle::place(double dt_s, const VehicleState& found) {
  FLYBALL_ASSERT(dt_s >= 0.0, "dt_s=%g", dt_s);
  FLYBALL_ASSERT(found.X_WB.matrix().allFinite(), "the pose is not finite: z=%g",
                 found.X_WB.translation().z());
  const auto spatial = [](const Vec3& v) { return SimTK::Vec3{v.x(), v.y(), v.z()}; };
  const Eigen::Quaterniond q{found.X_WB.linear()};
  BodyMotion motion;
  motion.attitude = {q.w(), q.x(), q.y(), q.z()};
  motion.p_WB = spatial(found.X_WB.translation());
  motion.V_WB = {spatial(found.X_WB.linear() * found.w_WB_B), spatial(found.v_WB)};
  body_->dynamics->place(motion);
  body_->seen = found;
  body_->turn_placed_camera(dt_s);
}

const VehicleState& Vehicle::state() const {
  return body_->seen;
}

void Vehicle::set_payload(double payload_kg) {
  FLYBALL_ASSERT(payload_kg >= 0.0, "payload_kg=%g", payload_kg);
  const BodyMotion motion = body_->dynamics->motion();
  const GimbalJoints angles = gimbal_joints();
  const GimbalJoints rates =
      body_->gimballed != nullptr ? body_->gimballed->joint_rates() : GimbalJoints{};
  body_->made_of.payload_kg = payload_kg;
  body_->build();
  body_->dynamics->place(motion);
  if (body_->gimballed != nullptr) {
    body_->gimballed->place_joints(angles, rates);
  }
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
  return body_->gimballed != nullptr ? body_->gimballed->joints() : GimbalJoints{};
}

Pose Vehicle::camera_pose() const {
  FLYBALL_ASSERT(body_->gimballed != nullptr, "this vehicle has no gimbal");
  const SimTK::Transform X = body_->gimballed->camera_X_W();
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
  return body_->dynamics->kinetic_j();
}

double Vehicle::potential_j() const {
  return mass_kg() * gravity_m_s2 *
         (body_->dynamics->centre_of_mass_W()[2] - body_->shape.ground_z_m);
}

double Vehicle::shaft_power_w() const {
  double sum_n3 = 0.0;
  for (const double n : body_->seen.rotor_rev_s) {
    sum_n3 += n * n * n;
  }
  return body_->made_of.airframe.power_per_n3() * sum_n3;
}

}  // namespace flyball
