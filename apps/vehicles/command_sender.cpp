// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/command_sender.h"

#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto answer_within = 500ms;  // Chosen: ten round trips of a slow serial line.
constexpr int most_tries = 5;          // Chosen; MAVLink's guide says "several".
constexpr auto try_later_after = 1s;   // Checks before arming run about once a second.
constexpr auto work_within = 10s;      // An autopilot that is at it says so again before.

}  // namespace

void CommandSender::ask(const MavCommandLong& command, std::string what, Duration now) {
  asked_ = command;
  what_ = std::move(what);
  failure_.clear();
  is_accepted_ = false;
  tries_ = 0;
  unanswered_ = 0;
  next_ = now;
}

void CommandSender::forget() {
  asked_.reset();
  failure_.clear();
}

void CommandSender::give_up(const std::string& how) {
  failure_ = "the autopilot was asked " + what_ + " and " + how;
}

std::optional<MavCommandLong> CommandSender::due(Duration now) {
  if (!is_waiting() || now < next_) {
    return std::nullopt;
  }
  if (unanswered_ >= most_tries) {
    give_up("did not answer, " + std::to_string(most_tries) + " times");
    return std::nullopt;
  }
  MavCommandLong command = *asked_;
  command.confirmation = static_cast<std::uint8_t>(unanswered_);
  ++tries_;
  ++unanswered_;
  next_ = now + answer_within;
  return command;
}

void CommandSender::hear(const MavCommandAck& answer, Duration now) {
  if (!is_waiting() || tries_ == 0 || answer.command != asked_->command) {
    return;
  }
  unanswered_ = 0;
  if (answer.result == mav::result_accepted) {
    is_accepted_ = true;
  } else if (answer.result == mav::result_in_progress) {
    next_ = now + work_within;
  } else if (answer.result == mav::result_try_later && tries_ < most_tries) {
    next_ = now + try_later_after;
  } else {
    give_up("answered " + mavlink_result_name(answer.result));
  }
}

}  // namespace flyball
