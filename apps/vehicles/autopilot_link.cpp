// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/autopilot_link.h"

#include "vehicles/offboard_control.h"
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto longest_wait = 10ms;   // Half the period of the set-points.
constexpr auto landed_within = 2min;  // Chosen: 80 m at the .7 m/s of both autopilots.
constexpr auto ask_again_after = 2s;

}  // namespace

AutopilotLink::AutopilotLink(std::unique_ptr<ByteStream> stream,
                             std::function<void(const std::string&)> tell)
    : stream_{std::move(stream)}, tell_{std::move(tell)} {}

AutopilotLink::~AutopilotLink() = default;

void AutopilotLink::exchange(Duration now) {
  now_ = now;
  received_.clear();
  Status heard = stream_->receive(received_);
  control_->hear(received_.data(), received_.size(), now);
  control_->advance(now);
  const std::vector<std::uint8_t> output = control_->take_output();
  const Status sent = output.empty() ? Status{Done{}} : stream_->send(output);
  for (const std::string& sentence : control_->take_news()) {
    tell_(sentence);
  }
  const Status& worse = heard ? sent : heard;
  if (!worse && !is_broken_) {
    tell_(worse.error().message);
  }
  is_broken_ = !worse;
}

Status AutopilotLink::connect(const FlightStart& start, const std::function<bool()>& stop) {
  control_ = std::make_unique<OffboardControl>(start);
  while (!control_->is_connected()) {
    if (stop && stop()) {
      return Error{ErrorCode::unavailable, "stopped while connecting to the autopilot"};
    }
    exchange(now_ + stream_->wait(longest_wait));
    if (!control_->failure().empty()) {
      return Error{ErrorCode::unavailable, control_->failure()};
    }
  }
  at_mission_ = now_;
  tell_(std::string{control_->autopilot_name()} + " is connected");
  return Done{};
}

void AutopilotLink::step(MissionTime now) {
  exchange(at_mission_ + now.time_since_epoch());
  if (!control_->failure().empty() && !has_failed_) {
    has_failed_ = true;
    tell_(control_->failure());
  }
}

void AutopilotLink::obey(const FlightCommand& command) {
  control_->obey(command, now_);
}

void AutopilotLink::follow(const Setpoint& setpoint) {
  Setpoint shifted = setpoint;
  shifted.stamp += at_mission_;
  control_->follow(shifted);
}

ReportedMotion AutopilotLink::motion() const {
  const VehicleMotion seen = control_->motion(now_);
  return {
      seen.X_WB, seen.v_WB, seen.w_WB_B, seen.a_WB, control_->is_armed(), control_->is_fresh(now_)};
}

FlightStatus AutopilotLink::status() const {
  return control_->status(now_);
}

bool AutopilotLink::may_touch_ground() const {
  return control_->may_touch_ground();
}

std::string AutopilotLink::failure() const {
  return control_->failure();
}

void AutopilotLink::begin_landing() {
  obey({FlightCommand::Kind::land, 0.0});
  exchange(now_);
}

void AutopilotLink::await_landing(const std::function<bool()>& turned) {
  const Duration until = now_ + landed_within;
  if (control_->is_in_charge()) {
    tell_("the vehicle lands before the program ends; a second Ctrl-C leaves it to its autopilot");
  }
  Duration next_try = now_;
  while (control_->is_in_charge() && now_ < until) {
    if (!control_->is_landing() && now_ >= next_try) {  // It was refused, or nobody answered.
      obey({FlightCommand::Kind::land, 0.0});
      next_try = now_ + ask_again_after;
    }
    if (turned) {
      (void)turned();
    }
    exchange(now_ + stream_->wait(longest_wait));
  }
  if (control_->is_in_charge()) {
    tell_("the vehicle has not landed within two minutes; it is left to its autopilot");
  }
}

}  // namespace flyball
