// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Knobs that a preset pins, for policies that leave them alone in flight.

#include "flyball/runtime/decision.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"

#include <string>
#include <vector>

namespace flyball {

/// One parameter for each standard knob; 0 leaves the knob to the scenario. All but
/// `frequency_hz`, which a rule for the clock sets itself.
[[nodiscard]] std::vector<ParameterSpec> fixed_setting_parameters();
[[nodiscard]] ParameterSpec fixed_frequency_parameter();

/// The wish that pins them, those of these parameters that `given` has declared.
/// @param owner  For messages: `policy "fixed"`.
/// @error `invalid_input` for a value outside of what the knob can take. Within that the governor
/// takes the nearest legal value, as of any wish: the lattice of a mapper, the clocks of a board.
[[nodiscard]] Result<Decision> fixed_settings(const std::string& owner,
                                              const Parameters& given,
                                              const KnobSettings& knobs);

}  // namespace flyball
