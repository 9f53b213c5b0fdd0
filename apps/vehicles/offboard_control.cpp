// SPDX-License-Identifier: BSD-3-Clause
//
// What goes in and out is here; how the connection is made, offboard_connection.cpp says, and how a
// flight goes, offboard_flight.cpp.

#include "vehicles/offboard_control.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto heartbeat_period = 1s;  // MAVLink's heartbeat protocol.

std::array<float, 3> fields_of(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// As it is sent.
MavPositionTarget position_target(const Setpoint& setpoint, const LocalOrigin& origin) {
  MavPositionTarget target;
  target.p_m = fields_of(origin.to_N(setpoint.p_WB));
  target.v_m_s = fields_of(north_east_down_turned(setpoint.v_WB));
  target.a_m_s2 = fields_of(north_east_down_turned(setpoint.a_WB));
  target.yaw_rad = static_cast<float>(yaw_turned(setpoint.yaw_rad));
  // ArduPilot flies yaw and yaw rate together wrongly (its pull request 18156), so one is left out.
  target.type_mask = mav::ignore_yaw_rate;
  return target;
}

bool is_finite(const MavPositionTarget& target) {
  const auto all = [](const std::array<float, 3>& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
  };
  return all(target.p_m) && all(target.v_m_s) && all(target.a_m_s2) &&
         std::isfinite(target.yaw_rad);
}

}  // namespace

void OffboardControl::enter(Leg leg, Duration now) {
  leg_ = leg;
  since_ = now;
}

void OffboardControl::fail(std::string sentence) {
  if (failure_.empty()) {
    failure_ = std::move(sentence);
  }
  commands_.forget();
}

void OffboardControl::ask(MavCommandLong command, std::string what, Duration now) {
  command.target_system = telemetry_.system();
  command.target_component = mav::component_autopilot;
  commands_.ask(command, std::move(what), now);
}

void OffboardControl::hear(const std::uint8_t* bytes, std::size_t count, Duration now) {
  has_heard_bytes_ = has_heard_bytes_ || count > 0;
  for (const MavlinkFrame& frame : reader_.read(bytes, count)) {
    telemetry_.hear(frame, now);
    if (!telemetry_.is_from_autopilot(frame)) {
      continue;
    }
    if (frame.id == MavCommandAck::kind.id) {
      const auto answer = mavlink_message<MavCommandAck>(frame);
      const bool is_for_us = answer.target_component == 0 ||
                             answer.target_component == mav::component_onboard_computer;
      if (is_for_us) {
        commands_.hear(answer, now);
      }
    } else if (frame.id == MavParamValue::kind.id) {
      hear_limit(mavlink_message<MavParamValue>(frame), now);
    }
  }
}

VehicleMotion OffboardControl::present(Duration now) const {
  VehicleMotion motion = telemetry_.motion(now);
  if (!telemetry_.is_fresh(now) && stream_.sent()) {
    motion.X_WB.translation() = stream_.sent()->p_WB;
    motion.v_WB = stream_.sent()->v_WB;
  }
  return motion;
}

void OffboardControl::beat(Duration now) {
  if (!telemetry_.kind() || (next_beat_ && now < *next_beat_)) {
    return;
  }
  next_beat_ = now + heartbeat_period;
  MavHeartbeat heartbeat;
  heartbeat.type = mav::type_onboard_controller;
  heartbeat.autopilot = mav::autopilot_none;
  heartbeat.system_status = mav::state_active;
  send(heartbeat);
}

void OffboardControl::send_setpoint(const Setpoint& setpoint, Duration now) {
  MavPositionTarget target = position_target(setpoint, telemetry_.origin());
  if (!is_finite(target)) {  // A good one may run away before the next one comes.
    return;
  }
  target.time_boot_ms = static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
  target.target_system = telemetry_.system();
  target.target_component = mav::component_autopilot;
  send(target);
}

void OffboardControl::advance(Duration now) {
  telemetry_.look(now);
  beat(now);
  if (!is_connected_ && failure_.empty()) {
    step_connection(now);
  } else if (is_connected_) {
    step_flight(now);
  }
  if (const auto command = commands_.due(now)) {
    send(*command);
  }
  if (const auto setpoint = stream_.due(now, present(now))) {
    send_setpoint(*setpoint, now);
  }
}

void OffboardControl::obey(const FlightCommand& command, Duration now) {
  switch (command.kind) {
    case FlightCommand::Kind::take_off:
      take_off(command.height_m, now);
      break;
    case FlightCommand::Kind::land:
      come_down(now);
      break;
    case FlightCommand::Kind::hold:
      if (leg_ == Leg::climbing || leg_ == Leg::flying) {
        stream_.stop(present(now), now);
        enter(Leg::flying, now);
      }
      break;
    case FlightCommand::Kind::release_payload:
      break;  // Whoever hangs a payload on a real vehicle has a device of his own for it.
  }
}

void OffboardControl::follow(const Setpoint& setpoint) {
  if (leg_ != Leg::flying) {
    return;
  }
  const bool is_good = is_finite(position_target(setpoint, telemetry_.origin())) &&
                       std::isfinite(setpoint.yaw_rate_rad_s);
  if (is_good) {
    stream_.follow(setpoint);
  } else if (!has_refused_setpoint_) {
    has_refused_setpoint_ = true;
    telemetry_.tell("a set-point that is not finite was refused");
  }
}

bool OffboardControl::is_in_charge() const {
  return leg_ == Leg::arming || leg_ == Leg::climbing || leg_ == Leg::flying ||
         leg_ == Leg::landing;
}

FlightStatus OffboardControl::status(Duration now) const {
  const bool is_slow = telemetry_.motion(now).v_WB.norm() < hovering_m_s;
  const bool holds = leg_ == Leg::flying && stream_.motion() != SetpointStream::Motion::follow;
  return {leg_ != Leg::standing, leg_ == Leg::standing || (holds && is_slow)};
}

bool OffboardControl::may_touch_ground() const {
  return leg_ != Leg::flying;
}

}  // namespace flyball
