// SPDX-License-Identifier: BSD-3-Clause
#include "failed_plans.h"

namespace flyball {
namespace {

constexpr double rounding_m = 1e-9;
constexpr double longest_m = 100.0;  // Between two observations; more than that must be a fault.

}  // namespace

FailedPlans::FailedPlans(const std::vector<double>& levels_m, double large_m) : large_m_{large_m} {
  for (const double resolution_m : levels_m) {
    levels_.push_back({resolution_m});
    const Level& added = levels_.back();
    per_m_.push_back(resolution_m > large_m ? added.failures / added.flown_m : 0.0);
  }
}

void FailedPlans::note(const Observation& seen, double resolution_m) {
  const double flown_m = last_ ? seen.speed_m_s * to_seconds(seen.now - *last_) : 0.0;
  last_ = seen.now;
  const bool has_flown = flown_m > 0.0 && flown_m < longest_m;
  // Failures in a row have one cause and count once.
  const bool has_failed = seen.planner_failures > 0 && in_a_row_ == 0 && resolution_m > large_m_;
  in_a_row_ = seen.planner_failures;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    if (level.resolution_m <= large_m_) {
      continue;
    }
    level.flown_m += has_flown && level.resolution_m <= resolution_m + rounding_m ? flown_m : 0.0;
    level.failures += has_failed && level.resolution_m >= resolution_m - rounding_m ? 1.0 : 0.0;
    per_m_[i] = level.failures / level.flown_m;
  }
}

}  // namespace flyball
