// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How the events of a scenario strain the computer at one moment.

#include "flyball/runtime/modeled/drifting_platform.h"
#include "flyball/scenario/scenario.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Names out of `octomap, rrt_connect`; empty for `all`.
[[nodiscard]] std::vector<std::string> kernels_of(const ComputerEvent& event);

[[nodiscard]] MissionTime begin_of(const ComputerEvent& event);
/// Empty: it lasts.
[[nodiscard]] std::optional<MissionTime> end_of(const ComputerEvent& event);
[[nodiscard]] bool is_active(const ComputerEvent& event, MissionTime now);

/// The strain at a time, without a cap on the clock. Slowdowns of one kernel multiply. Co-runners
/// add up, and the shares of memory bandwidth that they leave multiply. A kernel waits for memory
/// in inverse proportion to the bandwidth that is left to it.
[[nodiscard]] Strain strain_at(const std::vector<ComputerEvent>& events, MissionTime now);

/// The events that the platform cannot represent, one sentence each.
[[nodiscard]] std::vector<Error> impossible_events(const std::vector<ComputerEvent>& events,
                                                   const PlatformModel& platform);

/// `slowdown: 3 times the costs of all kernels`; `slowdown ends`.
[[nodiscard]] std::string describe(const ComputerEvent& event, bool begins);

}  // namespace flyball
