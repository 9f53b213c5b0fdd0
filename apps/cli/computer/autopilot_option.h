// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The autopilot that a command is told to fly with.

#include "flyball/runtime/result.h"
#include "flyball/scenario/override.h"
#include "flyball/vehicles/autopilot_link.h"

#include "cli/computer/real_computer.h"
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

struct AutopilotOption {
  std::string address{};  ///< Empty: the vehicle is simulated.
};

/// Adds `--autopilot`.
void add_autopilot(CLI::App& command, AutopilotOption& option);

/// The scenario of `load_overridden_scenario`. With an autopilot what is not overridden is made
/// careful (`make_careful`).
/// @param told  Out: the sentence that says so; empty where nothing was changed.
[[nodiscard]] std::variant<Scenario, std::vector<Error>> load_to_fly(
    const std::string& name_or_path,
    const std::vector<Override>& overrides,
    const Plugins& plugins,
    const AutopilotOption& option,
    std::string& told);

/// The line to it, if the options ask for one; null if they do not. Nothing is sent yet.
/// @error `invalid_input` without the real-time executor; those of `open_byte_stream`.
[[nodiscard]] Result<std::unique_ptr<AutopilotLink>> open_autopilot(
    const AutopilotOption& option, const ExecutorOptions& executor);

}  // namespace flyball
