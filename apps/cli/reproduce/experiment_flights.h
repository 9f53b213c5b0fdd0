// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The flights of several experiments, each flown once even where several sweeps have it.

#include "cli/stored_flights.h"
#include "experiments/framework/results.h"
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flyball {

struct ReproduceRequest {
  std::vector<NamedExperiment> experiments{};
  std::size_t seeds{};  ///< Of each sweep, unless it takes fewer.
  StoredBatch batch{};
};

/// A sweep of an experiment, whose flights stand in `ExperimentFlights::flights`.
struct PlannedSweep {
  std::size_t experiment{};  ///< Of the request.
  std::string name{};
  SweepPlan plan{};
  std::string command{};                      ///< That flies this sweep alone.
  std::vector<std::string> point_commands{};  ///< One for each point.
  std::vector<std::size_t> flights{};         ///< Seed by seed within a point, point by point.
};

struct ExperimentFlights {
  std::vector<StoredFlight> flights{};
  std::vector<PlannedSweep> sweeps{};
};

/// Reads and checks the scenario of every flight; every mistake once.
[[nodiscard]] std::variant<ExperimentFlights, std::vector<Error>> plan_experiments(
    const ReproduceRequest& request);

/// What the experiments make of their flights. @pre All flights have their summaries.
[[nodiscard]] std::vector<ExperimentResult> results_of(const ReproduceRequest& request,
                                                       const ExperimentFlights& flown);

}  // namespace flyball
