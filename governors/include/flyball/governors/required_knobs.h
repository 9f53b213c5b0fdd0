// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The knobs that a policy cannot do without.

#include "flyball/runtime/knob.h"
#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

/// @param owner  For the message: `policy "density"`.
/// @error `invalid_input` that names all that are missing at once.
[[nodiscard]] Status require_knobs(const std::string& owner,
                                   const KnobSettings& knobs,
                                   const std::vector<std::string>& names);

}  // namespace flyball
