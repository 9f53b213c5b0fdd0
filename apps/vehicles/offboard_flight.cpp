// SPDX-License-Identifier: BSD-3-Clause
//
// The legs of a flight, from the command to take off until the vehicle stands again.

#include "vehicles/offboard_control.h"
#include <cmath>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto stream_before = 1500ms;  // PX4 wants 1 s of set-points before it takes the mode.
constexpr auto show_within = 5s;  // Until a HEARTBEAT, of one a second, says what was granted.
constexpr double near_m = 0.3;    // What PX4's own off-board test accepts as arrived.

}  // namespace

/// A command that fails ends what it was for: on the ground the flight has not begun, and a vehicle
/// that is armed is held until it can be landed, which disarms it where it stands.
void OffboardControl::step_flight(Duration now) {
  watch_hands();
  if (!commands_.failure().empty()) {
    fail(commands_.failure());
    enter(telemetry_.is_armed() ? Leg::flying : Leg::standing, now);
    if (leg_ == Leg::standing) {
      stream_.end();
    }
  }
  switch (leg_) {
    case Leg::streaming:
      return prepare(now);
    case Leg::switching:
      return await_mode(now);
    case Leg::arming:
      return await_arming(now);
    case Leg::climbing:
      return climb(now);
    case Leg::landing:
      return await_landing(now);
    default:
      return;
  }
}

/// From the moment in which the autopilot was in our mode, another one, or none, is somebody else's
/// decision: a pilot's, a ground station's or a fail-safe's.
void OffboardControl::watch_hands() {
  const bool is_arming = leg_ == Leg::arming;
  const bool is_up = leg_ == Leg::climbing || leg_ == Leg::flying;
  if (!is_arming && !is_up && (leg_ != Leg::landing || !telemetry_.is_armed())) {
    return;
  }
  const std::uint32_t mode = telemetry_.mode();
  const bool is_ours =
      mode == commanded_mode(kind()) || (leg_ == Leg::landing && mode == landing_mode(kind()));
  if (is_ours && (is_arming || telemetry_.is_armed())) {
    return;
  }
  fail(is_ours ? std::string{"the autopilot was disarmed in flight"}
               : "somebody took over: the autopilot went to " + mode_name(kind(), mode) +
                     ", which Flyball did not ask for; it no longer commands the vehicle");
  stream_.end();
  leg_ = Leg::out_of_hand;
}

void OffboardControl::prepare(Duration now) {
  if (waited(kind() == AutopilotKind::px4 ? stream_before : Duration::zero(), now)) {
    ask(command_to_be_commanded(kind()),
        std::string{"to fly in mode "} + mode_name(kind(), commanded_mode(kind())), now);
    enter(Leg::switching, now);
  }
}

/// An answer may be lost on its way; what the autopilot shows counts.
void OffboardControl::await_mode(Duration now) {
  if (telemetry_.mode() == commanded_mode(kind())) {
    MavCommandLong arm;
    arm.command = mav::command_arm;
    arm.parameters[0] = 1.0F;
    ask(arm, "to arm", now);
    enter(Leg::arming, now);
  } else if (commands_.is_waiting()) {
    since_ = now;
  } else if (waited(show_within, now)) {
    stream_.end();
    fail("the autopilot said yes to " + mode_name(kind(), commanded_mode(kind())) +
         " and stays in " + mode_name(kind(), telemetry_.mode()));
    enter(Leg::standing, now);
  }
}

void OffboardControl::await_arming(Duration now) {
  if (telemetry_.is_armed()) {
    commands_.forget();
    enter(Leg::climbing, now);
    const double rise_m = goal_height_m_ - telemetry_.motion(now).X_WB.translation().z();
    if (kind() == AutopilotKind::px4) {
      stream_.climb(present(now), goal_height_m_, now);
    } else {
      MavCommandLong climb;
      climb.command = mav::command_take_off;
      climb.parameters[6] = static_cast<float>(rise_m);  // Above home, which is where it was armed.
      ask(climb, "to take off", now);
    }
  } else if (commands_.is_waiting()) {
    since_ = now;
  } else if (waited(show_within, now)) {
    stream_.end();
    fail("the autopilot said yes to arming and stays disarmed");
    enter(Leg::standing, now);
  }
}

void OffboardControl::climb(Duration now) {
  if (!telemetry_.is_on_ground().value_or(true)) {
    commands_.forget();  // ArduPilot denies a vehicle in the air what an answer was lost of.
  }
  const VehicleMotion motion = telemetry_.motion(now);
  const double left_m = goal_height_m_ - motion.X_WB.translation().z();
  if (std::abs(left_m) < near_m && motion.v_WB.norm() < hovering_m_s) {
    if (stream_.motion() == SetpointStream::Motion::none) {
      stream_.stop(motion, now);
    }
    enter(Leg::flying, now);
  }
}

/// The stream goes on until the autopilot shows that it lands: without it PX4 would lose patience.
void OffboardControl::await_landing(Duration now) {
  if (telemetry_.mode() == landing_mode(kind())) {
    stream_.end();
    commands_.forget();
    is_landing_granted_ = true;
  }
  is_landing_granted_ = is_landing_granted_ || commands_.is_accepted();
  if (is_landing_granted_ && !telemetry_.is_armed() && telemetry_.is_on_ground().value_or(false)) {
    stream_.end();
    enter(Leg::standing, now);
  }
}

void OffboardControl::take_off(double height_m, Duration now) {
  goal_height_m_ = start_.ground_z_m + height_m;
  const VehicleMotion motion = present(now);
  if (leg_ == Leg::climbing || leg_ == Leg::flying) {
    stream_.climb(motion, goal_height_m_, now);
    enter(Leg::climbing, now);
  } else if (leg_ == Leg::standing) {
    if (kind() == AutopilotKind::px4) {
      stream_.stop(motion, now);
    }
    enter(Leg::streaming, now);
  }
}

void OffboardControl::give_up(std::string sentence, Duration now) {
  fail(std::move(sentence));
  come_down(now);
}

/// Where nothing is armed yet, nothing will be.
void OffboardControl::come_down(Duration now) {
  if (leg_ == Leg::streaming || leg_ == Leg::switching) {
    stream_.end();
    commands_.forget();
    enter(Leg::standing, now);
  } else if (is_in_charge()) {
    land(now);
  }
}

void OffboardControl::land(Duration now) {
  MavCommandLong land;
  land.command = mav::command_land;
  ask(land, "to land", now);
  is_landing_granted_ = false;
  if (stream_.motion() != SetpointStream::Motion::none) {
    stream_.stop(present(now), now);
  }
  enter(Leg::landing, now);
}

}  // namespace flyball
