// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/required_knobs.h"

#include "flyball/runtime/text/listed.h"

namespace flyball {

Status require_knobs(const std::string& owner,
                     const KnobSettings& knobs,
                     const std::vector<std::string>& names) {
  const std::string missing = listed(
      names, [&knobs](const std::string& name) { return knobs.spec(name) == nullptr ? name : ""; });
  if (missing.empty()) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               owner + ": there is no knob " + missing + "; try: flyball list knobs"};
}

double smallest_cells_m(const KnobSpec& resolution, double given_m) {
  constexpr double usual_m = 0.15;  // MAVBench's fine cells.
  if (given_m > 0.0) {
    return resolution.nearest(given_m);
  }
  return resolution.legal.empty() ? usual_m : resolution.legal.front();
}

}  // namespace flyball
