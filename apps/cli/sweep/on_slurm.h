// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Many flights on a cluster. Each task of the job array flies some of the missing flights into a
/// store of its own, in the shared folder; the command that waits for them adds the stores to its
/// own.

#include "cli/stored_flights.h"
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// Flights that are handed to Slurm.
struct FlightArray {
  std::string folder{};                ///< All nodes share it.
  std::vector<std::string> command{};  ///< Of one task, up to its part: `2/8`.
  std::size_t processors{};
  bool keeps_records{};
};

/// Flies what the store does not know, array after array, as long as each brings something. Where a
/// command before this one was interrupted, its array is awaited first.
/// @return The code to end with, after saying why; empty: every flight has its summary.
[[nodiscard]] std::optional<int> fly_on_slurm(const FlightArray& array,
                                              FlightStore& store,
                                              const std::vector<StoredFlight*>& flights);

/// Plans the flight of a number, whose record goes into `folder`. The numbers are places in the
/// list that `fly_on_slurm` was given.
/// @error Also for a number beyond that list.
using PlanFlight = std::function<std::variant<StoredFlight, std::vector<Error>>(
    std::size_t number, const std::string& folder)>;

/// What one task does.
/// @param part  `2/8`: those of the missing flights that the second of eight tasks was given.
/// @return The code to end with.
[[nodiscard]] int fly_part(const StoredBatch& batch,
                           const std::string& part,
                           const PlanFlight& plan);

}  // namespace flyball
