// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/policy_trouble.h"

namespace flyball {

void PolicyTrouble::add(const Summary& flight) {
  decisions += flight.decisions;
  faults += flight.policy_faults;
  why = why.empty() ? flight.policy_trouble : why;
}

std::string PolicyTrouble::text(const std::string& policy) const {
  const std::string what = trouble_text(faults, decisions, why);
  return what.empty() ? "" : "policy " + policy + " " + what;
}

}  // namespace flyball
