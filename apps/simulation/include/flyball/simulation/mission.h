// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Flies one scenario from take-off to its end.

#include "flyball/mcap/onboard_record.h"
#include "flyball/records/mission_record.h"
#include "flyball/records/timeline.h"
#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/executor.h"
#include "flyball/runtime/realtime/realtime_board.h"
#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"
#include "flyball/simulation/rendering.h"
#include "flyball/vehicles/autopilot_link.h"
#include "flyball/vehicles/depth_source.h"

#include <functional>
#include <memory>
#include <string>

namespace flyball {

/// What runs the graph of a mission. All arguments outlive the executor; the simulator is on the
/// queue, and so must be whatever the executor does at a time.
using MakeExecutor = std::function<std::unique_ptr<Executor>(
    const Graph&, const Platform&, EventQueue&, const OperatingPoint&)>;

struct MissionHooks {
  /// Called about every 10 s of mission time: progress in words for a terminal.
  std::function<void(double mission_s, const std::string& what)> progress{};
  /// Asked often; true ends the mission as `interrupted`.
  std::function<bool()> stop{};
  /// Called once when the mission is over, before its jobs are stopped, the vehicle is landed and
  /// the map is written: all of that may take long, and asks `stop` seldom.
  std::function<void()> over{};
  std::string start_map{};  ///< An OctoMap file that is known at take-off; empty: nothing is.
  std::string final_map{};  ///< Where the map goes in the end, `.bt` or `.ot`; empty: nowhere.
  Timeline* timeline{};     ///< Is told of all jobs; null: nothing is.
  /// Called with each job that has ended, after it, on the caller's thread.
  std::function<void(const NodeSpec&, const JobRecord&)> job{};
  Rendering rendering{};
  OnboardRecord* onboard_record{};  ///< Is connected before the start; null: there is none.
  /// The real computer that the executor runs the nodes on: it is refreshed while the mission
  /// flies, and its watts and heat count. Null: the scenario's platform is modeled.
  RealtimeBoard* computer{};
  /// Flies the vehicle, while the simulator renders its cameras at the pose that it reports; is
  /// connected before the flight, and has landed after it. Null: the vehicle is simulated.
  AutopilotLink* autopilot{};
  /// The vehicle's depth camera, whose first image is waited for before the flight. Null: it is
  /// drawn.
  DepthSource* depth_camera{};
  MakeExecutor executor{};  ///< Empty: a `VirtualExecutor`, which models the scenario's computer.
};

/// @error `not_found` for an unknown kernel, policy, world, airframe or platform, with the way out;
///        those of `Mapper::read` and `Mapper::write` for the map files, and of
///        `AutopilotLink::connect` and `DepthSource::await`.
[[nodiscard]] Result<MissionRecord> fly(const Scenario& scenario, const MissionHooks& hooks);

/// The workload's graph, printed: as text, or for Graphviz.
/// @error As `fly`.
[[nodiscard]] Result<std::string> describe_graph(const Scenario& scenario, bool as_dot);

}  // namespace flyball
