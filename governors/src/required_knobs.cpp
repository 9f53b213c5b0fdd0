// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/required_knobs.h"

namespace flyball {

Status require_knobs(const std::string& owner,
                     const KnobSettings& knobs,
                     const std::vector<std::string>& names) {
  std::string missing;
  for (const std::string& name : names) {
    if (knobs.spec(name) == nullptr) {
      missing += (missing.empty() ? "" : ", ") + name;
    }
  }
  if (missing.empty()) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               owner + ": there is no knob " + missing + "; try: flyball list knobs"};
}

}  // namespace flyball
