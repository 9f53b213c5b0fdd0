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

/// Reads the given values into `scenario.events` and checks that the platform can represent them.
///
/// @return  Errors: unknown kinds and keys, missing keys, wrong types and bounds, kernels without a
///          price, co-runners that leave no core, cooling for a platform without a thermal model.
[[nodiscard]] std::vector<Error> read_events(Scenario& scenario, const GivenValues& given);

/// The entries for `flyball config`, without their origins.
[[nodiscard]] std::vector<ConfigEntry> event_entries(const Scenario& scenario);
/// As `[[events]]` tables; empty without events.
[[nodiscard]] std::string events_toml(const Scenario& scenario);

}  // namespace flyball
