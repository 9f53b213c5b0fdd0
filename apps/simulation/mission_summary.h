// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a flight that is over came to.

#include "flyball/records/summary.h"

#include "simulation/simulated_flight.h"

namespace flyball {

/// All but what tells of the program and the host.
[[nodiscard]] Summary summary_of(const SimulatedFlight& flight, const Scenario& scenario);

}  // namespace flyball
