// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A sweep on a cluster. Each task of the job array flies some of the missing flights into a store
/// of its own, in the shared folder; the command that waits for them adds the stores to the
/// sweep's.

#include "cli/sweep/sweep_flights.h"
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Flies what the store does not know, array after array, as long as each brings something. Where a
/// command before this one was interrupted, its array is awaited first.
/// @return The code to end with, after saying why; empty: every flight has its summary.
[[nodiscard]] std::optional<int> fly_on_slurm(const SweepRequest& request,
                                              std::size_t processors,
                                              FlightStore& store,
                                              const std::vector<StoredFlight*>& flights);

/// What one task does.
/// @param part  `2/8`: every eighth of the missing flights, from the second one on.
/// @return The code to end with.
[[nodiscard]] int fly_part(const SweepRequest& request, const std::string& part);

}  // namespace flyball
