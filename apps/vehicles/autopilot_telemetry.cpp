// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/autopilot_telemetry.h"

#include "flyball/flight/perception/pose_history.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto silence = 3s;                          // Three heartbeats.
constexpr Duration oldest_motion = longest_pose_age;  // Older poses stop the vehicle.

template <std::size_t n>
bool are_finite(const std::array<float, n>& fields) {
  return std::all_of(fields.begin(), fields.end(),
                     [](float field) { return std::isfinite(field); });
}

Vec3 vector_of(const std::array<float, 3>& fields) {
  return {fields[0], fields[1], fields[2]};
}

std::string seconds_text(Duration time) {
  return std::to_string(std::llround(to_seconds(time))) + " s";
}

}  // namespace

bool AutopilotTelemetry::is_from_autopilot(const MavlinkFrame& frame) const {
  return kind_ && frame.system == system_ && frame.component == mav::component_autopilot;
}

void AutopilotTelemetry::hear(const MavlinkFrame& frame, Duration now) {
  if (frame.id == MavHeartbeat::kind.id) {
    hear_heartbeat(frame, now);
  }
  if (!is_from_autopilot(frame)) {
    return;
  }
  if (frame.is_signed && !has_told_of_signature_) {
    has_told_of_signature_ = true;
    tell("the autopilot signs its messages; the signatures are not checked");
  }
  switch (frame.id) {
    case MavAttitudeQuaternion::kind.id:
      hear_attitude(mavlink_message<MavAttitudeQuaternion>(frame), now);
      break;
    case MavLocalPosition::kind.id:
      hear_position(mavlink_message<MavLocalPosition>(frame), now);
      break;
    case MavSystemStatus::kind.id:
      hear_battery(mavlink_message<MavSystemStatus>(frame), now);
      break;
    case MavExtendedState::kind.id:
      is_on_ground_ =
          mavlink_message<MavExtendedState>(frame).landed_state == mav::landed_on_ground;
      break;
    case MavStatusText::kind.id:
      hear_text(mavlink_message<MavStatusText>(frame));
      break;
    default:
      break;
  }
}

/// Ground stations, cameras and gimbals have heartbeats, too: they say that they are no autopilot.
void AutopilotTelemetry::hear_heartbeat(const MavlinkFrame& frame, Duration now) {
  const auto heartbeat = mavlink_message<MavHeartbeat>(frame);
  if (!kind_ && heartbeat.autopilot != mav::autopilot_none &&
      frame.component == mav::component_autopilot) {
    system_ = frame.system;
    kind_ = autopilot_kind(heartbeat);
  }
  if (!is_from_autopilot(frame) || heartbeat.autopilot == mav::autopilot_none) {
    return;
  }
  if (is_silent_) {
    tell("the autopilot is heard again, after " + seconds_text(now - *heartbeat_heard_));
    is_silent_ = false;
  }
  heartbeat_ = heartbeat;
  heartbeat_heard_ = now;
}

void AutopilotTelemetry::hear_position(const MavLocalPosition& position, Duration now) {
  if (!are_finite(position.p_m) || !are_finite(position.v_m_s)) {
    return;
  }
  const Vec3 p_N = vector_of(position.p_m);
  const Vec3 v_N = vector_of(position.v_m_s);
  const double step_s = 1e-3 * (position.time_boot_ms - static_cast<double>(position_boot_ms_));
  constexpr double longest_step_s = 0.25;
  if (position_made_ && step_s > 0.0) {
    a_N_ = step_s < longest_step_s ? Vec3{(v_N - v_N_) / step_s} : Vec3::Zero();
    follow_jump(p_N, v_N, step_s);
  }
  p_N_ = p_N;
  v_N_ = v_N;
  position_boot_ms_ = position.time_boot_ms;
  position_made_ = clock_.made(position.time_boot_ms, now);
}

/// A jump is what no multirotor flies: more than both velocities and 20 m/s^2 explain.
void AutopilotTelemetry::follow_jump(const Vec3& p_N, const Vec3& v_N, double step_s) {
  constexpr double least_m = 0.5;  // Chosen: smaller ones are a gust for what flies.
  constexpr double most_m_s2 = 20.0;
  const Vec3 jump_N = p_N - p_N_ - 0.5 * step_s * (v_N_ + v_N);
  const double jump_m = jump_N.norm();
  if (!is_placed_ || jump_m <= least_m + 0.5 * most_m_s2 * step_s * step_s) {
    return;
  }
  origin_.start_N += jump_N;
  a_N_ = Vec3::Zero();
  std::array<char, 120> text{};
  std::snprintf(
      text.data(), text.size(),
      "the autopilot's position jumped by %.1f m; start and goal of the mission jump along",
      jump_m);
  tell(text.data());
}

void AutopilotTelemetry::hear_battery(const MavSystemStatus& status, Duration now) {
  battery_.reset();
  if (status.battery_mv == mav_unknown_voltage || status.battery_ca < 0) {
    return;
  }
  battery_heard_ = now;
  battery_ =
      ReportedBattery{Watts{1e-3 * status.battery_mv * 1e-2 * status.battery_ca}, std::nullopt};
  if (status.battery_percent >= 0) {
    battery_->percent = status.battery_percent;
  }
}

std::optional<ReportedBattery> AutopilotTelemetry::battery(Duration now) const {
  constexpr auto oldest_battery = 2s;  // Two messages of one a second.
  return now - battery_heard_ <= oldest_battery ? battery_ : std::nullopt;
}

void AutopilotTelemetry::hear_attitude(const MavAttitudeQuaternion& attitude, Duration now) {
  const auto& q = attitude.q;
  const Eigen::Quaterniond heard{q[0], q[1], q[2], q[3]};
  constexpr double shortest = 0.5;  // A quaternion of zeros says that it is not known.
  if (!are_finite(q) || !are_finite(attitude.rates_rad_s) || heard.norm() < shortest) {
    return;
  }
  q_ND_ = heard.normalized();
  w_D_ = vector_of(attitude.rates_rad_s);
  attitude_made_ = clock_.made(attitude.time_boot_ms, now);
}

void AutopilotTelemetry::hear_text(const MavStatusText& text) {
  const std::string piece = mavlink_text(text.text);
  const bool goes_on = text.id != 0 && piece.size() == text.text.size();
  text_ = text.id != 0 && text.id == text_id_ ? text_ + piece : piece;
  text_id_ = goes_on ? text.id : std::uint16_t{0};
  if (!goes_on && text.severity <= mav::severity_warning) {
    tell("autopilot: " + text_);
  }
}

void AutopilotTelemetry::look(Duration now) {
  if (heartbeat_heard_ && !is_silent_ && now - *heartbeat_heard_ >= silence) {
    is_silent_ = true;
    tell("the autopilot has not been heard for " + seconds_text(silence));
  }
  if (!has_position() || !has_attitude()) {
    return;
  }
  if (is_blind_ == is_fresh(now)) {
    is_blind_ = !is_blind_;
    tell_of_sight(is_blind_, now);
  }
}

/// A line that drops out again and again would bury every other sentence.
void AutopilotTelemetry::tell_of_sight(bool is_blind, Duration now) {
  constexpr auto pause = 10s;
  if (is_blind && now >= next_blind_news_) {
    next_blind_news_ = now + pause;
    has_told_blind_ = true;
    tell("the autopilot has not said for .25 s where it is");
  } else if (!is_blind && has_told_blind_) {
    has_told_blind_ = false;
    tell("the autopilot says again where it is");
  }
}

std::vector<std::string> AutopilotTelemetry::take_news() {
  return std::exchange(news_, {});
}

bool AutopilotTelemetry::is_fresh(Duration now) const {
  return has_position() && has_attitude() && now - *position_made_ <= oldest_motion &&
         now - *attitude_made_ <= oldest_motion;
}

VehicleMotion AutopilotTelemetry::motion(Duration now) const {
  const auto age_s = [now](const std::optional<Duration>& made) {
    const Duration age = made ? now - *made : Duration::zero();
    return to_seconds(std::clamp<Duration>(age, Duration::zero(), oldest_motion));
  };
  VehicleMotion motion;
  motion.v_WB = north_east_down_turned(v_N_);
  motion.a_WB = north_east_down_turned(a_N_);
  motion.w_WB_B = forward_right_down_turned(w_D_);
  const Vec3 turned = age_s(attitude_made_) * motion.w_WB_B;
  const double angle_rad = turned.norm();
  Eigen::Quaterniond q_WB = q_WB_of(q_ND_);
  if (angle_rad > 0.0) {
    q_WB = q_WB * Eigen::Quaterniond{Eigen::AngleAxisd{angle_rad, turned / angle_rad}};
  }
  motion.X_WB.linear() = q_WB.toRotationMatrix();
  motion.X_WB.translation() = origin_.to_W(p_N_) + age_s(position_made_) * motion.v_WB;
  return motion;
}

}  // namespace flyball
