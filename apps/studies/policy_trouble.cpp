// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/policy_trouble.h"

namespace flyball {

void PolicyTrouble::add(const Summary& flight) {
  add(PolicyTrouble{flight.decisions, flight.policy_faults, flight.policy_trouble});
}

void PolicyTrouble::add(const PolicyTrouble& others) {
  decisions += others.decisions;
  faults += others.faults;
  why = why.empty() ? others.why : why;
}

std::string PolicyTrouble::text(const std::string& policy) const {
  const std::string what = trouble_text(faults, decisions, why);
  return what.empty() ? "" : "policy " + policy + " " + what;
}

}  // namespace flyball
