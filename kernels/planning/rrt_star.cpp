// SPDX-License-Identifier: BSD-3-Clause
// flyball-link: flyball_ompl
//
// RRT* (Karaman and Frazzoli 2011, doi:10.1177/0278364911406761): one tree that is rewired towards
// shorter paths. After the first path it improves for as many iterations again, and a few more.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "ompl_search.h"
#include "staged_search.h"
#include <algorithm>
#include <cmath>

#include <ompl/geometric/planners/rrt/RRTstar.h>

namespace {

constexpr double range_m = 4.0;
constexpr int least_improvement = 500;  // Iterations after the first path.

/// Stops at the stage's limit, or when the improvement has had its share.
class Stop {
 public:
  explicit Stop(int max_iterations) : limit_{max_iterations} {}
  bool operator()(const ompl::geometric::RRTstar& planner, const flyball::PlanSampler&) {
    const int done = static_cast<int>(planner.numIterations());
    if (!improving_ && std::isfinite(planner.bestCost().value())) {
      improving_ = true;
      limit_ = std::min(limit_, done + std::max(done, least_improvement));
    }
    return done >= limit_;
  }

 private:
  int limit_;
  bool improving_{false};
};

flyball::StageResult search(const flyball::SearchStage& stage, flyball::MotionChecker& checker) {
  using Planner = ompl::geometric::RRTstar;
  return flyball::search_with_ompl<Planner>(
      stage, checker, [](Planner& planner) { planner.setRange(range_m); },
      Stop{stage.max_iterations},
      [](const Planner& planner, const flyball::PlanSampler&) {
        return static_cast<int>(planner.numIterations());
      });
}

class RrtStar final : public flyball::PathPlanner {
 public:
  flyball::Plan plan(const flyball::PlanRequest& request,
                     const flyball::OccupancyView& map) override {
    return flyball::staged_plan(request, map, search);
  }
};

}  // namespace

FLYBALL_PLUGIN(rrt_star) {
  registry.add<flyball::PathPlanner>("rrt_star", [] { return std::make_unique<RrtStar>(); });
}
