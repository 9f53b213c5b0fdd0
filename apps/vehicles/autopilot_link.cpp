// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/autopilot_link.h"

#include "flyball/runtime/realtime/cpus.h"

#include "vehicles/offboard_control.h"
#include <utility>

#include <pthread.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto longest_wait = 10ms;   // Half the period of the set-points.
constexpr auto landed_within = 2min;  // Chosen: 80 m at the .7 m/s of both autopilots.
constexpr auto ask_again_after = 2s;
// Chosen: longer than a simulator on a busy computer is late.
constexpr auto longest_silence = 5s;

}  // namespace

AutopilotLink::AutopilotLink(std::unique_ptr<ByteStream> stream,
                             std::function<void(const std::string&)> tell,
                             std::function<Duration()> clock)
    : stream_{std::move(stream)},
      tell_{std::move(tell)},
      clock_{std::move(clock)},
      clock_began_{clock_ ? clock_() : Duration::zero()},
      cpus_{usable_cpus()} {}

AutopilotLink::~AutopilotLink() {
  end_thread();
}

void AutopilotLink::exchange(Duration now) {
  now_ = now;
  received_.clear();
  Status heard = stream_->receive(received_);
  control_->hear(received_.data(), received_.size(), now);
  control_->advance(now);
  const std::vector<std::uint8_t> output = control_->take_output();
  const Status sent = output.empty() ? Status{Done{}} : stream_->send(output);
  for (std::string& sentence : control_->take_news()) {
    news_.push_back(std::move(sentence));
  }
  const Status& worse = heard ? sent : heard;
  if (!worse && !is_broken_) {
    news_.push_back(worse.error().message);
  }
  // Where there is nothing to send, sending succeeds over any line.
  is_broken_ = !worse || (is_broken_ && output.empty());
}

/// A flight that hangs does not brake, and its vehicle would hover until the battery is empty,
/// because set-points keep coming.
void AutopilotLink::watch_caller() {
  if (control_->is_in_charge() && !control_->is_landing() && now_ - called_ > longest_silence) {
    called_ = now_;  // Until it is told again.
    control_->give_up("the flight has not moved on for 5 s; the vehicle is landed", now_);
  }
}

void AutopilotLink::run() {
  pthread_setname_np(pthread_self(), "autopilot");
  come_first();
  (void)bind_thread(0, cpus_);
  while (!is_ending_) {
    (void)stream_->wait(longest_wait);
    bool is_broken{};
    {
      const Lock lock{mutex_};
      exchange(clock_() - clock_began_);
      watch_caller();
      is_broken = is_broken_;
    }
    if (is_broken) {  // A line that is gone may not wait.
      std::this_thread::sleep_for(longest_wait);
    }
  }
}

void AutopilotLink::end_thread() {
  is_ending_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void AutopilotLink::wait() {
  if (thread_.joinable()) {
    std::this_thread::sleep_for(longest_wait);
    const Lock lock{mutex_};
    called_ = now_;
  } else {
    const Duration took = stream_->wait(longest_wait);
    const Lock lock{mutex_};
    exchange(now_ + took);
  }
  tell_news();
}

void AutopilotLink::tell_news() {
  std::vector<std::string> news;
  {
    const Lock lock{mutex_};
    news.swap(news_);
  }
  for (const std::string& sentence : news) {
    tell_(sentence);
  }
}

Status AutopilotLink::connect(const FlightStart& start, const std::function<bool()>& stop) {
  control_ = std::make_unique<OffboardControl>(start);
  if (clock_) {
    thread_ = std::thread{[this] { run(); }};
  }
  while (!has_connected()) {
    if (stop && stop()) {
      end_thread();
      return Error{ErrorCode::unavailable, "stopped while connecting to the autopilot"};
    }
    wait();
    if (const std::string why = failure(); !why.empty()) {
      end_thread();
      return Error{ErrorCode::unavailable, why};
    }
  }
  tell_news();
  return Done{};
}

bool AutopilotLink::has_connected() {
  const Lock lock{mutex_};
  if (!control_->is_connected()) {
    return false;
  }
  mission_ = {};
  if (!clock_) {
    mission_.note({}, now_);
  }
  asked_ = called_ = now_;
  news_.push_back(std::string{control_->autopilot_name()} + " is connected");
  return true;
}

void AutopilotLink::step(MissionTime now) {
  {
    const Lock lock{mutex_};
    if (clock_) {
      mission_.note(now, clock_() - clock_began_);
    }
    asked_ = mission_.host(now);
    if (!clock_) {
      exchange(asked_);
    }
    called_ = now_;
    if (!control_->failure().empty() && !has_failed_) {
      has_failed_ = true;
      news_.push_back(control_->failure());
    }
  }
  tell_news();
}

void AutopilotLink::obey(const FlightCommand& command) {
  const Lock lock{mutex_};
  control_->obey(command, now_);
}

void AutopilotLink::follow(const Setpoint& setpoint) {
  const Lock lock{mutex_};
  Setpoint shifted = setpoint;
  shifted.stamp = MissionTime{mission_.host(setpoint.stamp)};
  control_->follow(shifted);
}

ReportedMotion AutopilotLink::motion() const {
  const Lock lock{mutex_};
  const VehicleMotion seen = control_->motion(asked_);
  return {
      seen.X_WB, seen.v_WB, seen.w_WB_B, seen.a_WB, control_->is_armed(), control_->is_fresh(now_)};
}

std::optional<ReportedBattery> AutopilotLink::battery() const {
  const Lock lock{mutex_};
  return control_->battery(now_);
}

FlightStatus AutopilotLink::status() const {
  const Lock lock{mutex_};
  return control_->status(asked_);
}

bool AutopilotLink::may_touch_ground() const {
  const Lock lock{mutex_};
  return control_->may_touch_ground();
}

std::string AutopilotLink::failure() const {
  const Lock lock{mutex_};
  return control_->failure();
}

void AutopilotLink::begin_landing() {
  const Lock lock{mutex_};
  control_->obey({FlightCommand::Kind::land, 0.0}, now_);
  if (!clock_) {
    exchange(now_);
  }
}

void AutopilotLink::await_landing(const std::function<bool()>& turned) {
  const Duration until = now() + landed_within;
  if (is_in_charge()) {
    tell_("the vehicle lands before the program ends; a second Ctrl-C leaves it to its autopilot");
  }
  while (is_in_charge() && now() < until) {
    insist_on_landing();
    if (turned) {
      (void)turned();
    }
    wait();
  }
  if (is_in_charge()) {
    tell_("the vehicle has not landed within two minutes; it is left to its autopilot");
  }
  end_thread();
}

/// It was refused, or nobody answered.
void AutopilotLink::insist_on_landing() {
  const Lock lock{mutex_};
  if (!control_->is_landing() && now_ >= next_landing_try_) {
    control_->obey({FlightCommand::Kind::land, 0.0}, now_);
    next_landing_try_ = now_ + ask_again_after;
  }
}

bool AutopilotLink::is_in_charge() const {
  const Lock lock{mutex_};
  return control_->is_in_charge();
}

Duration AutopilotLink::now() const {
  const Lock lock{mutex_};
  return now_;
}

}  // namespace flyball
