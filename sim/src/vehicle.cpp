// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/vehicle.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

#include <Simbody.h>

namespace flyball {
namespace {

// Legs of rubber on concrete: half a gram of sink per newton; nothing in flight depends on them.
constexpr double sink_at_rest_m = 0.002;       // own choice: gives the stiffness
constexpr double contact_damping_ratio = 0.7;  // own choice: no second bounce
constexpr double friction = 0.6;               // own choice
constexpr double friction_slip_m_s =
    0.05;  // below it friction is viscous, so that Euler stays stable
constexpr double contact_step_s = 0.001;  // the stiff contact bounds the step, flight does not
constexpr double payload_gap_m = 0.02;  // payload's centre below the body's lower face: own choice

SimTK::Vec3 simtk(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Vec3 eigen(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// What acts on the body now, and shares of it that the energy balance needs. Wrenches are about
/// the body's origin, in W.
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

Shape shape_of(const Airframe& a, double ground_z_m) {
  Shape shape;
  const auto rotors_B = a.rotor_points_B();
  for (std::size_t i = 0; i < 4; ++i) {
    shape.rotors_B[i] = simtk(rotors_B[i]);
    // A foot under the middle of each arm, on the lower face of the collision cylinder.
    shape.feet_B[i] =
        SimTK::Vec3{0.5 * rotors_B[i].x(), 0.5 * rotors_B[i].y(), -0.5 * a.body_height_m};
  }
  shape.drag_factor = 0.5 * air_density_kg_m3 * a.drag_area_m2;
  shape.ground_z_m = ground_z_m;
  const double share_kg = 0.25 * a.mass_kg;
  shape.stiffness_n_m = share_kg * gravity_m_s2 / sink_at_rest_m;
  shape.damping_n_s_m = 2.0 * contact_damping_ratio * std::sqrt(shape.stiffness_n_m * share_kg);
  return shape;
}

/// All forces but gravity.
class BodyForce final : public SimTK::Force::Custom::Implementation {
 public:
  BodyForce(const SimTK::MobilizedBody& body, const Shape& shape, Loads& loads)
      : body_{body}, shape_{shape}, loads_{loads} {}

  void calcForce(const SimTK::State& state,
                 SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                 SimTK::Vector_<SimTK::Vec3>& /*particle_forces*/,
                 SimTK::Vector& /*mobility_forces*/) const override {
    const SimTK::Transform& X_WB = body_.getBodyTransform(state);
    const SimTK::SpatialVec& V_WB = body_.getBodyVelocity(state);
    loads_.rotors = rotors(X_WB.R());
    loads_.drag = drag(V_WB[1]);
    loads_.contact = contact(X_WB, V_WB);
    body_.applyBodyForce(state, loads_.rotors + loads_.drag + loads_.contact, body_forces);
  }
  // Gravity's is counted by the vehicle; the legs' springs count as contact.
  SimTK::Real calcPotentialEnergy(const SimTK::State& /*state*/) const override { return 0.0; }

 private:
  SimTK::SpatialVec rotors(const SimTK::Rotation& R_WB) const {
    SimTK::Vec3 torque_B{0.0, 0.0, loads_.reaction_nm};
    double thrust_n = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double t = loads_.thrust_n[i];
      thrust_n += t;
      torque_B += SimTK::Vec3{shape_.rotors_B[i][1] * t, -shape_.rotors_B[i][0] * t, 0.0};
    }
    return {R_WB * torque_B, thrust_n * SimTK::Vec3{R_WB.z()}};
  }

  SimTK::SpatialVec drag(const SimTK::Vec3& v_WB) const {
    const SimTK::Vec3 airspeed = v_WB - simtk(loads_.wind_W);
    return {SimTK::Vec3{0.0}, -shape_.drag_factor * airspeed.norm() * airspeed};
  }

  SimTK::SpatialVec contact(const SimTK::Transform& X_WB, const SimTK::SpatialVec& V_WB) const {
    SimTK::SpatialVec sum{SimTK::Vec3{0.0}, SimTK::Vec3{0.0}};
    for (const SimTK::Vec3& foot_B : shape_.feet_B) {
      const SimTK::Vec3 arm = X_WB.R() * foot_B;
      const double sink_m = shape_.ground_z_m - (X_WB.p()[2] + arm[2]);
      if (sink_m <= 0.0) {
        continue;
      }
      const SimTK::Vec3 v = V_WB[1] + V_WB[0] % arm;
      const double normal_n =
          std::max(0.0, shape_.stiffness_n_m * sink_m - shape_.damping_n_s_m * v[2]);
      const double slip_m_s = std::max(friction_slip_m_s, std::hypot(v[0], v[1]));
      const double grip = friction * normal_n / slip_m_s;
      const SimTK::Vec3 force{-grip * v[0], -grip * v[1], normal_n};
      sum += SimTK::SpatialVec{arm % force, force};
    }
    return sum;
  }

  const SimTK::MobilizedBody& body_;
  const Shape& shape_;
  Loads& loads_;
};

SimTK::Body::Rigid rigid(const Airframe& a, double payload_kg) {
  const SimTK::Vec3 at{0.0, 0.0, -0.5 * a.body_size_m.z() - payload_gap_m};
  const double mass_kg = a.mass_kg + payload_kg;
  const Vec3 inertia = a.inertia_kg_m2();
  const SimTK::Inertia about_origin =
      SimTK::Inertia{inertia.x(), inertia.y(), inertia.z()} + SimTK::Inertia{at, payload_kg};
  return SimTK::Body::Rigid{
      SimTK::MassProperties{mass_kg, (payload_kg / mass_kg) * at, about_origin}};
}

/// One build of the multibody system; a new mass needs a new one.
struct System {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::Force::UniformGravity gravity{forces, matter, SimTK::Vec3{0.0, 0.0, -gravity_m_s2}};
  SimTK::MobilizedBody::Free body;
  SimTK::State state;

  System(const Airframe& airframe, double payload_kg, const Shape& shape, Loads& loads)
      : body{matter.Ground(), SimTK::Transform{}, rigid(airframe, payload_kg), SimTK::Transform{}} {
    SimTK::Force::Custom{forces, new BodyForce{body, shape, loads}};  // Simbody owns it.
    state = system.realizeTopology();
    system.realizeModel(state);
  }
};

}  // namespace

struct Vehicle::Body {
  Airframe airframe;
  double payload_kg;
  Shape shape;
  Loads loads;
  std::unique_ptr<System> physics;
  VehicleState seen;
  double rotor_work_j{};
  double drag_loss_j{};
  double contact_loss_j{};
  double lag_step_s{};  ///< The step that `lag_kept` is for.
  double lag_kept{};    ///< exp(-dt / tau)

  Body(const Airframe& a, double payload, double ground_z_m)
      : airframe{a}, payload_kg{payload}, shape{shape_of(a, ground_z_m)}, loads{} {
    build();
  }

  void build() { physics = std::make_unique<System>(airframe, payload_kg, shape, loads); }

  void turn_rotors(double dt_s, const RotorSpeeds& command);
  void integrate(double dt_s);
  void read_state(const SimTK::Vec3& a_WB);
};

/// First-order lag, exact for a constant command; thrust and torque follow from the mean of n^2
/// over the step, so the impulse of a spin-up does not depend on the step.
void Vehicle::Body::turn_rotors(double dt_s, const RotorSpeeds& command) {
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

void Vehicle::Body::integrate(double dt_s) {
  SimTK::State& state = physics->state;
  physics->system.realize(state, SimTK::Stage::Acceleration);
  const SimTK::Vector before = state.getU();
  const SimTK::Vector udot = state.getUDot();
  state.updU() += dt_s * udot;
  // Work at the mean speed of the step: with it a force's work is exactly the kinetic energy that
  // this scheme gives a mass.
  const SimTK::Vector mean = 0.5 * (before + state.getU());
  const SimTK::SpatialVec V_mean{SimTK::Vec3{mean[0], mean[1], mean[2]},
                                 SimTK::Vec3{mean[3], mean[4], mean[5]}};
  rotor_work_j += dt_s * (~loads.rotors * V_mean);
  drag_loss_j -= dt_s * (~loads.drag * V_mean);
  contact_loss_j -= dt_s * (~loads.contact * V_mean);
  physics->system.realize(state, SimTK::Stage::Velocity);
  state.updQ() += dt_s * state.getQDot();
  physics->matter.normalizeQuaternions(state);
  read_state(SimTK::Vec3{udot[3], udot[4], udot[5]});
}

void Vehicle::Body::read_state(const SimTK::Vec3& a_WB) {
  // Free joint: q = quaternion (w, x, y, z) and position; u = angular and linear velocity in W.
  const SimTK::Vector& q = physics->state.getQ();
  const SimTK::Vector& u = physics->state.getU();
  const Eigen::Matrix3d R_WB = Eigen::Quaterniond{q[0], q[1], q[2], q[3]}.toRotationMatrix();
  seen.X_WB.linear() = R_WB;
  seen.X_WB.translation() = Vec3{q[4], q[5], q[6]};
  seen.w_WB_B = R_WB.transpose() * Vec3{u[0], u[1], u[2]};
  seen.v_WB = Vec3{u[3], u[4], u[5]};
  seen.a_WB = eigen(a_WB);
}

Vehicle::Vehicle(const Airframe& airframe,
                 double payload_kg,
                 const Vec3& p_WB,
                 double yaw_rad,
                 double ground_z_m) {
  FLYBALL_ASSERT(airframe.validate().empty(), "%s", airframe.validate().front().message.c_str());
  FLYBALL_ASSERT(payload_kg >= 0.0, "payload_kg=%g", payload_kg);
  body_ = std::make_unique<Body>(airframe, payload_kg, ground_z_m);
  SimTK::Vector& q = body_->physics->state.updQ();
  q[0] = std::cos(0.5 * yaw_rad);
  q[1] = 0.0;
  q[2] = 0.0;
  q[3] = std::sin(0.5 * yaw_rad);
  for (int i = 0; i < 3; ++i) {
    q[4 + i] = p_WB[i];
  }
  body_->read_state(SimTK::Vec3{0.0});
}

Vehicle::~Vehicle() = default;

void Vehicle::step(double dt_s, const RotorSpeeds& command, const Vec3& wind_W) {
  FLYBALL_ASSERT(dt_s > 0.0, "dt_s=%g", dt_s);
  body_->loads.wind_W = wind_W;
  // Wider than the body is high: no foot of a tilted vehicle reaches the ground from above this.
  const double reach_m = body_->airframe.body_height_m + body_->airframe.arm_m;
  const bool may_touch = body_->seen.X_WB.translation().z() - body_->shape.ground_z_m < reach_m;
  const int parts =
      may_touch ? std::max(1, static_cast<int>(std::ceil(dt_s / contact_step_s - 1e-9))) : 1;
  for (int i = 0; i < parts; ++i) {
    body_->turn_rotors(dt_s / parts, command);
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
  body_->payload_kg = payload_kg;
  body_->build();
  body_->physics->state.updQ() = q;
  body_->physics->state.updU() = u;
}

double Vehicle::payload_kg() const {
  return body_->payload_kg;
}
double Vehicle::mass_kg() const {
  return body_->airframe.mass_kg + body_->payload_kg;
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

double Vehicle::kinetic_j() const {
  const System& physics = *body_->physics;
  physics.system.realize(physics.state, SimTK::Stage::Velocity);
  return physics.matter.calcKineticEnergy(physics.state);
}

double Vehicle::potential_j() const {
  const System& physics = *body_->physics;
  physics.system.realize(physics.state, SimTK::Stage::Position);
  const SimTK::Vec3 centre_W = physics.matter.calcSystemMassCenterLocationInGround(physics.state);
  return mass_kg() * gravity_m_s2 * (centre_W[2] - body_->shape.ground_z_m);
}

double Vehicle::shaft_power_w() const {
  double sum_n3 = 0.0;
  for (const double n : body_->seen.rotor_rev_s) {
    sum_n3 += n * n * n;
  }
  return body_->airframe.power_per_n3() * sum_n3;
}

}  // namespace flyball
