// SPDX-License-Identifier: BSD-3-Clause
#include "failed_plans.h"

namespace flyball {

void FailedPlans::note(const Observation& seen, bool in_large_cells) {
  const double way_m = last_ ? seen.speed_m_s * to_seconds(seen.now - *last_) : 0.0;
  last_ = seen.now;
  constexpr double longest_m = 100.0;  // Between two looks; more is a fault of whoever observes.
  if (in_large_cells && way_m > 0.0 && way_m < longest_m) {
    way_m_ += way_m;
  }
  // One cause, however often it is tried again.
  if (in_large_cells && seen.planner_failures > 0 && in_a_row_ == 0) {
    failures_ += 1.0;
  }
  in_a_row_ = seen.planner_failures;
}

}  // namespace flyball
