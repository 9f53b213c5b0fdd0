// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Flies one scenario from take-off to its end, on the virtual executor.

#include "flyball/records/mission_record.h"
#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"

#include <functional>
#include <string>

namespace flyball {

struct MissionHooks {
  /// Called about every 10 s of mission time: progress in words for a terminal.
  std::function<void(double mission_s, const std::string& what)> progress{};
  /// Asked often; true ends the mission as `interrupted`.
  std::function<bool()> stop{};
  std::string start_map{};  ///< An OctoMap file that is known at take-off; empty: nothing is.
  std::string final_map{};  ///< Where the map goes in the end, `.bt` or `.ot`; empty: nowhere.
};

/// @error `not_found` for an unknown kernel, policy, world, airframe or platform, with the way out;
///        those of `Mapper::read` and `Mapper::write` for the map files.
[[nodiscard]] Result<MissionRecord> fly(const Scenario& scenario, const MissionHooks& hooks);

/// The workload's graph, printed: as text, or for Graphviz.
/// @error As `fly`.
[[nodiscard]] Result<std::string> describe_graph(const Scenario& scenario, bool as_dot);

}  // namespace flyball
