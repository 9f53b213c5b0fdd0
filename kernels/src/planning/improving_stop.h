// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When a planner that goes on after its first path has done enough.

#include "planning/plan_sampler.h"
#include <algorithm>
#include <cmath>

namespace flyball {

/// Stops at the stage's limit, or when the improvement of the first path has had its share: as many
/// iterations again as that path took, and at least some.
class ImprovingStop {
 public:
  explicit ImprovingStop(int max_iterations) : limit_{max_iterations} {}

  /// @tparam Planner  Of OMPL, with `numIterations` and `bestCost`.
  template <class Planner>
  bool operator()(const Planner& planner, const PlanSampler&) {
    const int done = static_cast<int>(planner.numIterations());
    if (!improving_ && std::isfinite(planner.bestCost().value())) {
      improving_ = true;
      limit_ = std::min(limit_, done + std::max(done, least_improvement));
    }
    return done >= limit_;
  }

 private:
  static constexpr int least_improvement = 500;  // Iterations after the first path.
  int limit_;
  bool improving_{false};
};

}  // namespace flyball
