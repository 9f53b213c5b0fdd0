// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One command to the autopilot at a time, repeated until it is answered.

#include "flyball/runtime/time.h"

#include "vehicles/mavlink_messages.h"
#include <optional>
#include <string>

namespace flyball {

/// MAVLink's command protocol: an answer names the command's number and nothing else, so a second
/// command of the same number has to wait for the first one's answer.
class CommandSender {
 public:
  /// Forgets the one before, answered or not.
  /// @param what  For messages to people: "to arm".
  void ask(const MavCommandLong& command, std::string what, Duration now);
  void forget();

  /// The command, where it is due now: at first, and again while it is not answered.
  [[nodiscard]] std::optional<MavCommandLong> due(Duration now);
  void hear(const MavCommandAck& answer, Duration now);

  /// A command was sent, and nobody has said yet what becomes of it.
  [[nodiscard]] bool is_waiting() const { return asked_ && !is_accepted_ && failure_.empty(); }
  [[nodiscard]] bool is_accepted() const { return asked_ && is_accepted_; }
  /// One sentence once it was denied or not answered; else empty.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  void give_up(const std::string& how);

  std::optional<MavCommandLong> asked_{};
  std::string what_{};
  std::string failure_{};
  bool is_accepted_{};
  int tries_{};       ///< How often it was sent.
  int unanswered_{};  ///< How often since the last answer.
  Duration next_{};   ///< When it is due again.
};

}  // namespace flyball
