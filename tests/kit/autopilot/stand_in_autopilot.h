// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// An autopilot on the other end of a line: it keeps the rules of PX4 or ArduPilot as their sources
/// and guides say them, and flies the simulator's vehicle. It is ours, not theirs: a test with it
/// says that both sides here mean the same, and nothing about a real one.

#include "flyball/sim/airframe.h"
#include "flyball/sim/flight_controller.h"
#include "flyball/sim/vehicle.h"

#include "vehicles/autopilot_kind.h"
#include "vehicles/mavlink_messages.h"
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flyball::kit {

/// How it is set up, and what is wrong with it and its line.
struct StandInRules {
  AutopilotKind kind{AutopilotKind::px4};
  std::uint8_t maker{};                 ///< MAV_AUTOPILOT, if another one.
  std::uint8_t type{2};                 ///< MAV_TYPE: a quadrotor.
  Vec3 local_start_N{12.0, -7.0, 0.4};  ///< What it calls the place where it stands.
  double yaw_rad{0.3};                  ///< From east, anticlockwise.
  float guided_timeout_s{3.0F};
  std::map<std::string, float> parameters{{"WPNAV_ACCEL", 600.0F}, {"PSC_JERK_XY", 20.0F}};
  bool denies_arming{};
  bool denies_take_off{};
  bool denies_landing{};
  std::uint16_t deaf_to{};              ///< A command that it never answers.
  bool loses_answers{};                 ///< It does what it is told, and nobody hears that it will.
  int unanswered_first{};               ///< So many commands it does not answer at first.
  int lost_of{};                        ///< Each frame of so many is lost, both ways; 0: none.
  int twice_of{};                       ///< Each frame of so many comes twice; 0: none.
  std::uint32_t never_sends{0xffffff};  ///< A message, whatever is asked.
  std::uint32_t denies_message{0xffffff};  ///< It says that it does not send it.
  double swing_m{};        ///< Its estimate swings by so much around where it is, each way, in 5 s.
  float battery_a{-1.0F};  ///< What its power module measures at 20 V; negative: it has none.
};

class StandInAutopilot {
 public:
  StandInAutopilot(StandInRules rules, const Airframe& airframe)
      : rules_{std::move(rules)},
        stand_m_{0.5 * airframe.body_height_m},
        vehicle_{airframe, 0.0, {Vec3{0.0, 0.0, stand_m_}, rules_.yaw_rad, 0.0}},
        controller_{airframe, 0.0} {
    mode_ = is_px4() ? px4_position : 0;
  }

  // What a test looks at.
  [[nodiscard]] const VehicleState& truth() const { return vehicle_.state(); }
  /// Its place from where it stood at first, in east, north, up.
  [[nodiscard]] Vec3 moved_m() const {
    return vehicle_.state().X_WB.translation() - Vec3{0.0, 0.0, stand_m_};
  }
  [[nodiscard]] bool is_armed() const { return is_armed_; }
  [[nodiscard]] std::uint32_t mode() const { return mode_; }
  [[nodiscard]] bool is_up() const { return controller_.mode() != FlightMode::idle; }
  [[nodiscard]] const std::vector<MavCommandLong>& commands() const { return commands_; }
  [[nodiscard]] const std::vector<MavPositionTarget>& targets() const { return targets_; }
  [[nodiscard]] int heartbeats() const { return heartbeats_; }
  [[nodiscard]] double longest_target_gap_s() const { return longest_gap_s_; }
  /// How often somebody sent what no autopilot should get: not a number, or yaw and yaw rate.
  [[nodiscard]] int bad_targets() const { return bad_targets_; }

  // What a test does to it.
  StandInRules& rules() { return rules_; }
  void switch_mode(std::uint32_t mode) {  ///< As a pilot does.
    mode_ = mode;
    controller_.hold(vehicle_.state());
  }
  /// Its estimate of where it is jumps; what it was told to fly to does not.
  void jump(const Vec3& by_N) { rules_.local_start_N += by_N; }
  void arm() { is_armed_ = true; }
  void disarm() { is_armed_ = false; }
  void lose_output(bool is_lost) { loses_output_ = is_lost; }
  void be_silent(bool is_silent) { is_silent_ = is_silent; }
  void say(std::uint8_t severity, const std::string& words, std::uint16_t id = 0) {
    for (std::size_t at = 0; at < words.size(); at += 50) {
      MavStatusText text;
      text.severity = severity;
      text.id = id;
      text.piece = static_cast<std::uint8_t>(at / 50);
      const std::string piece = words.substr(at, 50);
      std::copy(piece.begin(), piece.end(), text.text.begin());
      send(text);
    }
  }

  void hear(const std::vector<std::uint8_t>& bytes) {
    for (const MavlinkFrame& frame : reader_.read(bytes.data(), bytes.size())) {
      if (!is_silent_ && !is_lost(heard_frames_)) {
        hear(frame);
      }
    }
  }

  /// Flies on in steps of 2 ms and sends what is due. What is left of `by` counts the next time.
  void step(Duration by) {
    constexpr Duration part = std::chrono::milliseconds{2};
    for (owed_ += by; owed_ >= part; owed_ -= part) {
      now_ += part;
      fly(to_seconds(part));
      if (!is_silent_) {
        send_due();
      }
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> take_output() { return std::exchange(output_, {}); }

  static constexpr std::uint32_t px4_position = 3U << 16U;
  static constexpr std::uint32_t px4_hold = (4U << 16U) | (3U << 24U);
  static constexpr std::uint32_t copter_loiter = 5;

 private:
  [[nodiscard]] bool is_px4() const { return rules_.kind == AutopilotKind::px4; }
  [[nodiscard]] bool is_lost(int& count) const {
    return rules_.lost_of > 0 && ++count % rules_.lost_of == 0;
  }
  [[nodiscard]] double since_s(Duration then) const { return to_seconds(now_ - then); }

  void fly(double dt_s) {
    const double loss_s = is_px4() ? 1.0 : static_cast<double>(rules_.guided_timeout_s);
    const bool is_ours = mode_ == commanded_mode(rules_.kind);
    if (is_armed_ && is_ours && controller_.mode() == FlightMode::trajectory &&
        since_s(last_target_) > loss_s) {
      switch_mode(is_px4() ? px4_hold : mode_);  // PX4's fail-safe; ArduPilot stops in GUIDED.
    }
    const RotorSpeeds speeds =
        controller_.update(vehicle_.state(), vehicle_.mass_kg(), MissionTime{now_}, dt_s);
    vehicle_.step(dt_s, is_armed_ ? speeds : RotorSpeeds{}, Vec3::Zero());
    const bool has_landed =
        mode_ == landing_mode(rules_.kind) && controller_.mode() == FlightMode::idle;
    landed_s_ = has_landed ? landed_s_ + dt_s : 0.0;
    const double disarm_s = is_px4() ? 2.0 : 0.1;
    if (landed_s_ > disarm_s) {
      is_armed_ = false;
    }
  }

  void hear(const MavlinkFrame& frame) {
    if (frame.id == MavHeartbeat::kind.id) {
      ++heartbeats_;
    } else if (frame.id == MavCommandLong::kind.id) {
      hear(mavlink_message<MavCommandLong>(frame));
    } else if (frame.id == MavPositionTarget::kind.id) {
      hear(mavlink_message<MavPositionTarget>(frame));
    } else if (frame.id == MavParamRequestRead::kind.id && !is_px4()) {
      tell_parameter(mavlink_message<MavParamRequestRead>(frame));
    }
  }

  void tell_parameter(const MavParamRequestRead& request) {
    const std::string name = mavlink_text(request.name);
    const auto found = rules_.parameters.find(name);
    if (name != "GUID_TIMEOUT" && found == rules_.parameters.end()) {
      return;
    }
    MavParamValue value;
    value.name = request.name;
    value.value = name == "GUID_TIMEOUT" ? rules_.guided_timeout_s : found->second;
    value.type = 9;
    send(value);
  }

  void hear(const MavCommandLong& command) {
    commands_.push_back(command);
    if (command.command == rules_.deaf_to || rules_.unanswered_first-- > 0) {
      return;
    }
    MavCommandAck answer;
    answer.command = command.command;
    answer.result = obey(command);
    answer.target_system = 1;
    answer.target_component = mav::component_onboard_computer;
    if (!rules_.loses_answers) {
      send(answer);
    }
  }

  std::uint8_t obey(const MavCommandLong& command) {
    constexpr std::uint8_t denied = 2;
    switch (command.command) {
      case mav::command_message_interval:
        if (static_cast<std::uint32_t>(command.parameters[0]) == rules_.denies_message) {
          return denied;
        }
        intervals_[static_cast<std::uint32_t>(command.parameters[0])] =
            std::chrono::microseconds{std::lround(command.parameters[1])};
        return mav::result_accepted;
      case mav::command_set_mode:
        return take_mode(command);
      case mav::command_arm:
        if (rules_.denies_arming || mode_ != commanded_mode(rules_.kind)) {
          return denied;
        }
        is_armed_ = true;
        armed_height_m_ = vehicle_.state().X_WB.translation().z();
        return mav::result_accepted;
      case mav::command_take_off:
        if (!is_armed_ || is_px4() || rules_.denies_take_off || moved_m().z() > 0.1) {
          return denied;
        }
        controller_.take_off(vehicle_.state(),
                             armed_height_m_ + static_cast<double>(command.parameters[6]));
        return mav::result_accepted;
      case mav::command_land:
        if (rules_.denies_landing) {
          return denied;
        }
        mode_ = landing_mode(rules_.kind);
        controller_.land(vehicle_.state());
        return mav::result_accepted;
      default:
        return 3;
    }
  }

  /// PX4: a stream for a second, with no gap of half a second in it.
  std::uint8_t take_mode(const MavCommandLong& command) {
    const bool has_stream =
        stream_since_ && since_s(*stream_since_) >= 1.0 && since_s(last_target_) < 0.5;
    if (is_px4() && !has_stream) {
      return mav::result_try_later;
    }
    mode_ = is_px4() ? static_cast<std::uint32_t>(command.parameters[1]) << 16U
                     : static_cast<std::uint32_t>(command.parameters[1]);
    return mav::result_accepted;
  }

  void hear(const MavPositionTarget& target) {
    const double gap_s = since_s(last_target_);
    if (!stream_since_ || gap_s > 0.5) {
      stream_since_ = now_;
    } else {
      longest_gap_s_ = std::max(longest_gap_s_, gap_s);
    }
    last_target_ = now_;
    targets_.push_back(target);
    const bool has_both = (target.type_mask & 0xc00U) == 0;
    Setpoint wanted;
    wanted.stamp = MissionTime{now_};
    // Written out here, and not by ned_frames.h: the other side's mistakes are not to be ours.
    const auto enu = [](const std::array<float, 3>& v) {
      return Vec3{static_cast<double>(v[1]), static_cast<double>(v[0]), -static_cast<double>(v[2])};
    };
    wanted.p_WB = enu(target.p_m) - start_ENU() + Vec3{0.0, 0.0, stand_m_} - swing_ENU();
    wanted.v_WB = enu(target.v_m_s);
    wanted.a_WB = enu(target.a_m_s2);
    wanted.yaw_rad = 0.5 * M_PI - static_cast<double>(target.yaw_rad);
    const bool is_finite = wanted.p_WB.allFinite() && wanted.v_WB.allFinite() &&
                           wanted.a_WB.allFinite() && std::isfinite(wanted.yaw_rad);
    bad_targets_ += has_both || !is_finite ? 1 : 0;
    // ArduPilot takes off by itself; before that it flies no set-point.
    const bool may_fly = is_armed_ && mode_ == commanded_mode(rules_.kind) && is_finite &&
                         (is_px4() || controller_.mode() != FlightMode::idle);
    if (may_fly) {
      controller_.follow(wanted);
    }
  }

  [[nodiscard]] Vec3 start_ENU() const {
    const Vec3& n = rules_.local_start_N;
    return {n.y(), n.x(), -n.z()};
  }

  /// As estimates by GPS do, of which this is a coarse picture.
  [[nodiscard]] Vec3 swing_ENU() const {
    const double turned = 2.0 * M_PI / 5.0 * to_seconds(now_);
    return rules_.swing_m * Vec3{std::sin(turned), std::cos(turned), 0.0};
  }

  void send_due() {
    const auto is_due = [this](std::uint32_t id) {
      const auto interval = intervals_.find(id);
      if (id == rules_.never_sends || interval == intervals_.end() || now_ < next_[id]) {
        return false;
      }
      next_[id] = now_ + interval->second;
      return true;
    };
    if (is_due(MavHeartbeat::kind.id)) {
      MavHeartbeat heartbeat;
      heartbeat.custom_mode = mode_;
      heartbeat.type = rules_.type;
      heartbeat.autopilot = is_px4() ? mav::autopilot_px4 : mav::autopilot_ardupilot;
      heartbeat.autopilot = rules_.maker != 0 ? rules_.maker : heartbeat.autopilot;
      heartbeat.base_mode = is_armed_ ? mav::flag_armed : std::uint8_t{0};
      send(heartbeat);
    }
    if (is_due(MavExtendedState::kind.id)) {
      MavExtendedState landed;
      landed.landed_state = is_up() && moved_m().z() > 0.05 ? 2 : mav::landed_on_ground;
      send(landed);
    }
    if (is_due(MavSystemStatus::kind.id)) {
      MavSystemStatus status;
      if (rules_.battery_a >= 0.0F) {
        status.battery_mv = 20000;
        status.battery_ca = static_cast<std::int16_t>(std::lround(100.0F * rules_.battery_a));
        status.battery_percent = 83;
      }
      send(status);
    }
    if (is_due(MavLocalPosition::kind.id)) {
      send(position());
    }
    if (is_due(MavAttitudeQuaternion::kind.id)) {
      send(attitude());
    }
  }

  [[nodiscard]] std::uint32_t boot_ms() const {
    return static_cast<std::uint32_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(now_).count());
  }

  static std::array<float, 3> ned(const Vec3& v) {
    return {static_cast<float>(v.y()), static_cast<float>(v.x()), static_cast<float>(-v.z())};
  }

  [[nodiscard]] MavLocalPosition position() const {
    MavLocalPosition said;
    said.time_boot_ms = boot_ms();
    said.p_m = ned(moved_m() + start_ENU() + swing_ENU());
    said.v_m_s = ned(truth().v_WB);
    return said;
  }

  /// R_ND, column by column: forward, right and down in north, east, down.
  [[nodiscard]] MavAttitudeQuaternion attitude() const {
    const Eigen::Matrix3d R = truth().X_WB.linear();
    Eigen::Matrix3d R_ND;
    const std::array<Vec3, 3> axes{R.col(0), -R.col(1), -R.col(2)};
    for (int i = 0; i < 3; ++i) {
      const Vec3& axis = axes[static_cast<std::size_t>(i)];
      R_ND.col(i) = Vec3{axis.y(), axis.x(), -axis.z()};
    }
    const Eigen::Quaterniond q{R_ND};
    const Vec3& w = truth().w_WB_B;
    MavAttitudeQuaternion said;
    said.time_boot_ms = boot_ms();
    said.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
              static_cast<float>(q.z())};
    said.rates_rad_s = {static_cast<float>(w.x()), static_cast<float>(-w.y()),
                        static_cast<float>(-w.z())};
    return said;
  }

  template <class Message>
  void send(const Message& message) {
    const auto bytes = mavlink_bytes(Message::kind, mavlink_payload(message), 1,
                                     mav::component_autopilot, sequence_++);
    if (loses_output_ || is_lost(sent_frames_)) {
      return;
    }
    output_.insert(output_.end(), bytes.begin(), bytes.end());
    if (rules_.twice_of > 0 && sequence_ % rules_.twice_of == 0) {
      output_.insert(output_.end(), bytes.begin(), bytes.end());
    }
  }

  StandInRules rules_;
  double stand_m_;
  Vehicle vehicle_;
  FlightController controller_;
  MavlinkReader reader_{{MavHeartbeat::kind, MavParamRequestRead::kind, MavCommandLong::kind,
                         MavPositionTarget::kind}};
  Duration now_{};
  Duration owed_{};
  std::uint32_t mode_{};
  bool is_armed_{};
  bool is_silent_{};
  bool loses_output_{};
  double landed_s_{};
  double armed_height_m_{};
  double longest_gap_s_{};
  Duration last_target_{};
  std::optional<Duration> stream_since_{};
  std::map<std::uint32_t, Duration> intervals_{{MavHeartbeat::kind.id, std::chrono::seconds{1}}};
  std::map<std::uint32_t, Duration> next_{};
  std::vector<MavCommandLong> commands_{};
  std::vector<MavPositionTarget> targets_{};
  int heartbeats_{};
  int bad_targets_{};
  int sent_frames_{};
  int heard_frames_{};
  std::uint8_t sequence_{};
  std::vector<std::uint8_t> output_{};
};

}  // namespace flyball::kit
