// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The knobs that every workload of this project has.

#include "flyball/runtime/knob.h"
#include "flyball/runtime/platform.h"
#include "flyball/scenario/scenario.h"

namespace flyball {

/// Defaults are the scenario's values; legal clocks and cores are the platform's.
///
/// @param resolutions_m  Those that the mapper maps at, ascending; empty: all.
[[nodiscard]] std::vector<KnobSpec> standard_knobs(const Scenario& scenario,
                                                   const Platform& platform,
                                                   const std::vector<double>& resolutions_m = {});

}  // namespace flyball
