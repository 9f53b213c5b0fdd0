// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// All parts of one flight, put together.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/governing/governor_loop.h"
#include "flyball/flight/workload.h"
#include "flyball/records/mission_record.h"
#include "flyball/simulation/mission.h"

#include "simulation/closed_loop.h"
#include "simulation/computer_drift.h"
#include "simulation/flight_recorder.h"
#include "simulation/judging/referee.h"
#include "simulation/mission_link.h"
#include "simulation/mission_setup.h"
#include "simulation/simulated_board.h"
#include "simulation/soft_errors.h"
#include <memory>

namespace flyball {

/// What of a flight is not simulated.
struct FlightHardware {
  MakeExecutor make_executor{};  ///< Empty: a modeled one.
  RealtimeBoard* board{};        ///< Null for one that is modeled.
  AutopilotLink* autopilot{};    ///< Null: the vehicle is simulated.
};

/// Everything that one flight needs, in the order in which it must be made: the nodes of its
/// workload, and vehicle, computer and referee around them.
struct SimulatedFlight {
  /// All arguments outlive the flight.
  SimulatedFlight(const Scenario& scenario,
                  MissionSetup& setup,
                  MemoryRecorder& trace,
                  std::unique_ptr<Workload> made,
                  const FlightHardware& on = {});

  EventQueue queue;
  std::unique_ptr<Workload> workload;
  Graph graph;
  DriftingPlatform computer;  ///< The true one: what is known of it on board is in the brief.
  SimulatedBoard board;
  FlightParts parts;
  int record_node{};
  std::shared_ptr<GovernorLoop> governor;  ///< Owners: its node and this.
  Duration period{};                       ///< Between decisions.
  bool has_autopilot{};                    ///< That is none of the simulator's.
  std::unique_ptr<Executor> executor;
  std::unique_ptr<MissionLink> link;
  std::unique_ptr<ClosedLoop> loop;
  std::unique_ptr<Referee> referee;
  std::unique_ptr<ComputerDrift> drift;
  std::unique_ptr<SoftErrors> soft_errors;
  std::unique_ptr<FlightRecorder> recorder;

 private:
  [[nodiscard]] std::shared_ptr<const Brief> adapted_brief(const Scenario& scenario,
                                                           const MissionSetup& setup,
                                                           const FlightHardware& on) const;
  void add_governing(const Scenario& scenario, MissionSetup& setup);
};

}  // namespace flyball
