// SPDX-License-Identifier: BSD-3-Clause
//
// Where to fly (modes, set-points) is here; how to push (loops, mixer) is in flight_loops.cpp.

#include "flyball/sim/flight_controller.h"

#include "flyball/runtime/motion/setpoint_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

// Manoeuvres that the controller makes by itself: own choices, gentle against its 6 m/s^2 limit.
constexpr double sink_m_s = 1.0;
constexpr double slow_sink_m_s = 0.4;
constexpr double slow_below_m = 1.0;
constexpr double stop_m_s2 = 5.0;
constexpr double set_point_loss_s = 1.0;  // PX4's off-board loss
constexpr double slow_m_s = 0.2;
constexpr double near_m = 0.1;
constexpr double touch_height_m = 0.02;
constexpr double touch_m_s = 0.1;
constexpr double touch_s = 0.2;

}  // namespace

FlightController::FlightController(const Airframe& airframe, double ground_z_m)
    : airframe_{airframe}, ground_z_m_{ground_z_m} {}

void FlightController::start_reference(const VehicleState& state) {
  reference_ = {};
  reference_.p_WB = state.X_WB.translation();
  reference_.v_WB = state.v_WB;
  reference_.yaw_rad = mode_ == FlightMode::idle ? yaw_of(state.X_WB.linear().col(0)) : yaw_rad_;
  reference_is_fresh_ = true;
}

void FlightController::take_off(const VehicleState& state, double height_m) {
  start_reference(state);
  reference_.v_WB = Vec3::Zero();
  yaw_rad_ = reference_.yaw_rad;
  yaw_rate_rad_s_ = 0.0;
  goal_height_m_ = ground_z_m_ + height_m;
  disturbance_ = Vec3::Zero();
  mode_ = FlightMode::take_off;
}

void FlightController::land(const VehicleState& state) {
  start_reference(state);
  touching_s_ = 0.0;
  mode_ = FlightMode::land;
}

void FlightController::hold(const VehicleState& state) {
  start_reference(state);
  mode_ = FlightMode::hold;
}

void FlightController::fly_velocity(const Vec3& v_WB, double yaw_rad) {
  if (mode_ != FlightMode::velocity) {
    reference_is_fresh_ = false;  // The next update starts it at the vehicle's state.
  }
  mode_ = FlightMode::velocity;
  goal_velocity_ = v_WB;
  setpoint_.yaw_rad = yaw_rad;
}

void FlightController::follow(const Setpoint& setpoint) {
  setpoint_ = setpoint;
  mode_ = FlightMode::trajectory;
}

bool FlightController::is_done(const VehicleState& state) const {
  const bool slow = state.v_WB.norm() < slow_m_s;
  switch (mode_) {
    case FlightMode::take_off:
      return slow && std::abs(state.X_WB.translation().z() - goal_height_m_) < near_m;
    case FlightMode::hold:
      return slow;
    case FlightMode::idle:
      return true;
    default:
      return false;
  }
}

double FlightController::feet_height_m(const VehicleState& state) const {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const Vec3& foot_B : airframe_.foot_points_B()) {
    lowest_m = std::min(lowest_m, (state.X_WB * foot_B).z());
  }
  return lowest_m - ground_z_m_;
}

void FlightController::sink(const VehicleState& state, double dt_s) {
  const double feet_m = feet_height_m(state);
  const double speed = feet_m > slow_below_m ? sink_m_s : slow_sink_m_s;
  reference_.v_WB = stepped_velocity(reference_.v_WB, {0.0, 0.0, -speed}, stop_m_s2 * dt_s);
  const bool touching = feet_m < touch_height_m && std::abs(state.v_WB.z()) < touch_m_s;
  touching_s_ = touching ? touching_s_ + dt_s : 0.0;
  if (touching_s_ > touch_s) {
    mode_ = FlightMode::idle;
  }
}

void FlightController::slew_velocity(double dt_s) {
  reference_.v_WB = stepped_velocity(reference_.v_WB, goal_velocity_, stop_m_s2 * dt_s);
  reference_.yaw_rad = setpoint_.yaw_rad;
}

Setpoint FlightController::target(const VehicleState& state, MissionTime now, double dt_s) {
  if (mode_ == FlightMode::trajectory) {
    const double age_s = to_seconds(now - setpoint_.stamp);
    if (age_s <= set_point_loss_s) {
      return extrapolated(setpoint_, age_s);
    }
    hold(state);
  }
  if (!reference_is_fresh_) {
    start_reference(state);
  }
  const Vec3 before = reference_.v_WB;
  switch (mode_) {
    case FlightMode::take_off:
      climb_reference(reference_, goal_height_m_, dt_s);
      break;
    case FlightMode::land:
      sink(state, dt_s);
      break;
    case FlightMode::velocity:
      slew_velocity(dt_s);
      break;
    default:
      brake_reference(reference_, dt_s);
  }
  move_reference(reference_, before, dt_s);
  return reference_;
}

/// Turns to the nearer side, within the limits on rate and acceleration.
void FlightController::slew_yaw(const Setpoint& wanted, double dt_s) {
  constexpr double settle_1_s = 8.0;  // Ends the square-root profile without chatter: own choice.
  const double gap = wrap_angle(wanted.yaw_rad - yaw_rad_);
  const double most = std::min(settle_1_s * std::abs(gap),
                               std::sqrt(2.0 * gains_.max_yaw_acceleration_rad_s2 * std::abs(gap)));
  const double limit = gains_.max_yaw_rate_rad_s;
  const double rate = std::clamp(wanted.yaw_rate_rad_s + std::copysign(most, gap), -limit, limit);
  const double largest = gains_.max_yaw_acceleration_rad_s2 * dt_s;
  const double change = std::clamp(rate - yaw_rate_rad_s_, -largest, largest);
  yaw_acceleration_rad_s2_ = change / dt_s;
  yaw_rate_rad_s_ += change;
  yaw_rad_ = wrap_angle(yaw_rad_ + yaw_rate_rad_s_ * dt_s);
}

}  // namespace flyball
