// SPDX-License-Identifier: BSD-3-Clause
#include "failed_plans.h"

namespace flyball {

void FailedPlans::note(const Observation& seen, bool in_large_cells) {
  const double flown_m = last_ ? seen.speed_m_s * to_seconds(seen.now - *last_) : 0.0;
  last_ = seen.now;
  constexpr double longest_m = 100.0;  // Between two observations; more than that must be a fault.
  if (in_large_cells && flown_m > 0.0 && flown_m < longest_m) {
    flown_m_ += flown_m;
  }
  // Failures in a row have one cause and count once.
  if (in_large_cells && seen.planner_failures > 0 && in_a_row_ == 0) {
    failures_ += 1.0;
  }
  in_a_row_ = seen.planner_failures;
}

}  // namespace flyball
