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

}  // namespace flyball
