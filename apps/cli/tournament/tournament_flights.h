// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a tournament is asked for, and its flights as missions that a store keeps.

#include "flyball/studies/tournament.h"

#include "cli/stored_flights.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <variant>
#include <vector>

namespace flyball {

struct TournamentOptions {
  FlightOptions flight{};  ///< Its scenario is empty: the worlds are.
  std::vector<std::string> worlds{};
  std::vector<std::string> policies{};
  std::string seeds{"1..3"};
  std::vector<std::string> pair_texts{};  ///< `MINE:OTHER`
  std::vector<PolicyPair> pairs{};        ///< The same, read.
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
  bool keeps_records{};
  bool shows_bound{};
  bool has_hindsight{};
  std::string ablated{};  ///< The policy to fly without each of its parts; empty: none.
};

/// A flight of a policy, and the policy's name in tables.
struct TournamentFlight : StoredFlight {
  std::string row{};
};
using TournamentFlights = std::vector<TournamentFlight>;

/// A policy as it is named for a flight, and in tables.
struct Flier {
  std::string policy;
  std::string row;
};

[[nodiscard]] std::string out_folder(const TournamentOptions& options);
[[nodiscard]] StoredBatch batch_of(const TournamentOptions& options);
/// Options of a flight in one of the worlds.
[[nodiscard]] FlightOptions flight_in(const TournamentOptions& options, const std::string& world);
/// The folder of that world's flights.
[[nodiscard]] std::string folder_of(const TournamentOptions& options, const std::string& world);

/// World by world, policy by policy, seed by seed; all are checked before the first one flies.
[[nodiscard]] std::variant<TournamentFlights, std::vector<Error>> plan_flights(
    const TournamentOptions& options,
    const std::vector<Flier>& fliers,
    const std::vector<std::uint64_t>& seeds);

}  // namespace flyball
