// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Says how a mission ended. The vehicle claims, the referee looks at the true world.

#include "simulation/closed_loop.h"
#include "simulation/judging/judge.h"
#include "simulation/judging/localization_judge.h"
#include "simulation/judging/tracking_score.h"
#include <memory>
#include <vector>

namespace flyball {

struct FlightVerdict {
  MissionStatus status{MissionStatus::interrupted};
  MissionFailure failure{MissionFailure::none};
};

/// What a referee looks at. All of it outlives it.
struct RefereedFlight {
  const Scenario& scenario;
  const SimulatedThings& things;
  const Graph& graph;
  Executor& executor;
  EventQueue& queue;
  ClosedLoop& loop;
  const Mapper& mapper;
};

/// Ends missions by collision, empty battery or their time limit, and asks a judge for each thing
/// that the graph publishes to be judged: `pose`, `sightings` with `finding`, `target`, `picture`,
/// and `explore.request`, whose sender makes a map.
class Referee {
 public:
  /// @param link  Outlives the referee.
  Referee(MissionLink& link, const RefereedFlight& flight);

  /// From now on it looks. After `ClosedLoop::start`.
  void start();
  /// What the vehicle claims, unless a judge objects.
  [[nodiscard]] FlightVerdict verdict() const;
  [[nodiscard]] std::map<std::string, double> figures() const;
  [[nodiscard]] std::vector<MissionFrame> frames() const;
  /// The least distance so far between the airborne body and anything, 5 m at most.
  [[nodiscard]] double min_clearance_m() const { return min_clearance_m_; }

 private:
  void appoint(const Graph& graph, Executor& executor, const Mapper& mapper);
  void check();

  MissionLink& link_;
  const Scenario& scenario_;
  const SimulatedThings& things_;
  EventQueue& queue_;
  ClosedLoop& loop_;
  Clearance clearance_;
  double min_clearance_m_;
  std::vector<std::unique_ptr<Judge>> judges_{};
};

}  // namespace flyball
