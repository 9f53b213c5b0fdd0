// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The off-board state machine against the stand-in autopilot, in virtual time.

#include "autopilot_in_memory.h"
#include "vehicles/offboard_control.h"
#include <functional>
#include <string>
#include <vector>

namespace flyball::kit {

/// Of an autopilot that is set up as it should be, of a kind.
inline StandInRules safe_rules(AutopilotKind kind) {
  StandInRules rules;
  rules.kind = kind;
  rules.guided_timeout_s = 0.5F;
  return rules;
}

struct OffboardRig {
  explicit OffboardRig(const StandInRules& rules = {}, double acceleration_m_s2 = 3.0)
      : max_acceleration_m_s2{acceleration_m_s2},
        autopilot{rules, shipped_airframe()},
        control{{start_W, ground_z_m, max_acceleration_m_s2}} {}

  /// Turns of 10 ms until `done`, or for so long. Returns whether `done`.
  bool run(
      Duration at_most, const std::function<bool()>& done = [] { return false; }) {
    constexpr Duration turn = std::chrono::milliseconds{10};
    for (const Duration end = now + at_most; now < end;) {
      autopilot.step(turn);
      now += turn;
      const std::vector<std::uint8_t> heard = autopilot.take_output();
      control.hear(heard.data(), heard.size(), now);
      if (each_turn) {
        each_turn();
      }
      control.advance(now);
      const std::vector<std::uint8_t> said = control.take_output();
      sent.insert(sent.end(), said.begin(), said.end());
      autopilot.hear(said);
      for (const std::string& sentence : control.take_news()) {
        news += sentence + "\n";
      }
      if (done()) {
        return true;
      }
    }
    return false;
  }

  bool connect() {
    return run(std::chrono::minutes{2},
               [this] { return control.is_connected() || !control.failure().empty(); }) &&
           control.is_connected();
  }
  bool is_done() { return control.status(now).manoeuvre_done || !control.failure().empty(); }
  bool take_off(double height_m) {
    control.obey({FlightCommand::Kind::take_off, height_m}, now);
    return run(std::chrono::seconds{30}, [this] { return is_done(); }) && control.failure().empty();
  }
  bool land() {
    control.obey({FlightCommand::Kind::land, 0.0}, now);
    return run(std::chrono::minutes{1}, [this] { return is_done(); }) && control.failure().empty();
  }
  /// Streams set-points at 50 Hz along a line from where the vehicle is, for so long.
  void fly(const Vec3& v_WB, Duration by, double yaw_rad = 0.0) {
    const Vec3 from_W = control.motion(now).X_WB.translation();
    const Duration begun = now;
    each_turn = [this, from_W, begun, v_WB, yaw_rad] {
      Setpoint setpoint;
      setpoint.stamp = MissionTime{now};
      setpoint.p_WB = from_W + to_seconds(now - begun) * v_WB;
      setpoint.v_WB = v_WB;
      setpoint.yaw_rad = yaw_rad;
      control.follow(setpoint);
    };
    run(by);
    each_turn = {};
  }

  const double max_acceleration_m_s2;
  const Vec3 start_W{100.0, 50.0, -2.9};
  const double ground_z_m{-3.0};
  StandInAutopilot autopilot;
  OffboardControl control;
  Duration now{};
  std::function<void()> each_turn{};
  std::string news{};
  std::vector<std::uint8_t> sent{};  ///< All that our side said.
};

}  // namespace flyball::kit
