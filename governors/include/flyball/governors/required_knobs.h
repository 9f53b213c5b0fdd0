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

/// The smallest cells that a policy uses: those nearest to `given_m` or, where that is 0, the
/// finest of the mapper, which a mission chooses for its narrowest gap. A mapper without a lattice
/// has none, and gets .15 m.
[[nodiscard]] double smallest_cells_m(const KnobSpec& resolution, double given_m);

}  // namespace flyball
