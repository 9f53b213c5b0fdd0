// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The knobs of a mission: those that its kernels declare, and those of mission and platform.

#include "flyball/runtime/knob.h"
#include "flyball/runtime/platform.h"
#include "flyball/scenario/scenario.h"

namespace flyball {

/// Those of all eleven kernels that the scenario names, in the order in which data passes through
/// them, then speed, the rates that the scenario asks for, cores and clock. A knob whose name is a
/// setting of the scenario begins with that setting's value; clocks and cores are the platform's.
///
/// @error `not_found` or `invalid_input`: a kernel that is not there, a parameter of one that is
///        wrong, a switch without a price, a rate that nothing has, two knobs of one name, a knob
///        whose first value is not legal, or too many of them.
[[nodiscard]] Result<std::vector<KnobSpec>> standard_knobs(const Scenario& scenario,
                                                           const Platform& platform);
/// With the platform that the scenario names.
/// @error Those of its file, too.
[[nodiscard]] Result<std::vector<KnobSpec>> standard_knobs(const Scenario& scenario);

}  // namespace flyball
