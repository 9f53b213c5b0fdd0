// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Flies one scenario from take-off to its end, on the virtual executor.

#include "flyball/records/mission_frame.h"
#include "flyball/records/summary.h"
#include "flyball/runtime/recorder.h"
#include "flyball/runtime/registry.h"
#include "flyball/scenario/scenario.h"
#include "flyball/sim/world.h"

#include <functional>
#include <memory>
#include <vector>

namespace flyball {

struct MissionRecord {
  Summary summary{};
  World world{};
  std::vector<MissionFrame> frames{};  ///< What the workload wants to be seen.
  /// Channels and fields: see apps/README.md. `state` has 10 rows a second.
  std::shared_ptr<MemoryRecorder> trace{};  ///< Owners: the record and whoever writes it out.
};

struct MissionHooks {
  /// Called about every 10 s of mission time: progress in words for a terminal.
  std::function<void(double mission_s, const std::string& what)> progress{};
  /// Asked often; true ends the mission as `interrupted`.
  std::function<bool()> stop{};
  std::string start_map{};  ///< An OctoMap file that is known at take-off; empty: nothing is.
  std::string final_map{};  ///< Where the map goes in the end, `.bt` or `.ot`; empty: nowhere.
};

/// Every kernel, policy, world and workload compiled in, and what was added.
[[nodiscard]] const Registry& all_plugins();
/// Kernels, policies, worlds and workloads of the caller's own; scenarios ask for them by name.
/// Before the first flight, from one thread.
///
/// @param add  A `FLYBALL_PLUGIN` function, or one that calls several. A name that is taken is a
///             programming error, as it is in the tree.
void add_plugins(const std::function<void(Registry&)>& add);

/// @error `not_found` for an unknown kernel, policy, world, airframe or platform, with the way out;
///        those of `Mapper::read` and `Mapper::write` for the map files.
[[nodiscard]] Result<MissionRecord> fly(const Scenario& scenario, const MissionHooks& hooks);

/// The workload's graph, printed: as text, or for Graphviz.
/// @error As `fly`.
[[nodiscard]] Result<std::string> describe_graph(const Scenario& scenario, bool as_dot);

}  // namespace flyball
