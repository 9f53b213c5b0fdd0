// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The autopilot that a command is told to fly with.

#include "flyball/records/summary.h"
#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"
#include "flyball/vehicles/autopilot_link.h"

#include "cli/computer/real_computer.h"
#include <memory>
#include <string>

namespace flyball {

struct AutopilotOption {
  std::string address{};  ///< Empty: the vehicle is simulated.
};

/// Adds `--autopilot`.
void add_autopilot(CLI::App& command, AutopilotOption& option);

/// The line to it, if the options ask for one; null if they do not. Nothing is sent yet.
/// @error `invalid_input` without the real-time executor; those of `open_byte_stream`.
[[nodiscard]] Result<std::unique_ptr<AutopilotLink>> open_autopilot(
    const AutopilotOption& option, const ExecutorOptions& executor);

/// A sentence when the autopilot did not keep to its path as the scenario says; else empty. Where
/// it is farther off, the flight waits for it; near obstacles, room is needed for what it really
/// keeps.
[[nodiscard]] std::string tracking_remark(const Summary& summary, const Scenario& scenario);

}  // namespace flyball
