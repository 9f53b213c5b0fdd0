// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The `[[events]]` of a scenario: what happens to the companion computer in flight.

#include "scenario/scenario_reader.h"
#include <string>
#include <vector>

namespace flyball {

/// Whether `key` belongs to an event (`events.1.at_s`), known or not: `read_events` judges it.
[[nodiscard]] bool is_event_key(const std::string& key);

/// Takes what was given into `scenario.events`, and looks whether the platform can do it.
///
/// @return  Unknown kinds and keys, what is missing, wrong kinds and bounds, kernels without a
///          price, co-runners that leave no core, heat where nothing is known of it.
[[nodiscard]] std::vector<Error> read_events(Scenario& scenario, const GivenValues& given);

/// Without their origins.
[[nodiscard]] std::vector<ConfigEntry> event_entries(const Scenario& scenario);
/// As `[[events]]` tables; empty without events.
[[nodiscard]] std::string events_toml(const Scenario& scenario);

}  // namespace flyball
