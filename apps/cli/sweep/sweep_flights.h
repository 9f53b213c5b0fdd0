// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The flights of a sweep: each one as a command and as a mission that a store keeps.

#include "flyball/studies/sweep.h"

#include "cli/stored_flights.h"
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// What the user asked for, read and checked as far as no flight is needed for it.
struct SweepRequest {
  FlightOptions flight{};
  SweepPlan plan{};
  StoredBatch batch{};
};

/// All flights of a sweep by number: seed by seed within a point, point by point.
[[nodiscard]] std::size_t flight_count(const SweepRequest& request);
/// Reads and checks the scenario of one flight.
/// @error `invalid_input`, also for a number that no flight has.
[[nodiscard]] std::variant<StoredFlight, std::vector<Error>> plan_sweep_flight(
    const SweepRequest& request, std::size_t number);
/// All of them; every mistake once.
[[nodiscard]] std::variant<std::vector<StoredFlight>, std::vector<Error>> plan_sweep(
    const SweepRequest& request);

/// `flyball run ...` that flies one of them again.
[[nodiscard]] std::string command_of(const StoredFlight& flight);
/// `flyball compare ...` for each point: the same flights side by side.
[[nodiscard]] std::vector<std::string> point_commands(const SweepRequest& request);

/// `flyball sweep ...` that flies all of them, without where to; `flyball compare ...` where no
/// setting varies.
[[nodiscard]] std::vector<std::string> sweep_words(const SweepRequest& request);

/// The words as a shell reads them back: in quotes where needed.
[[nodiscard]] std::string shell_text(const std::vector<std::string>& words);

}  // namespace flyball
