// SPDX-License-Identifier: BSD-3-Clause
// flyball-link: flyball_ompl
//
// RRT-Connect (Kuffner and LaValle 2000, doi:10.1109/ROBOT.2000.844730): two trees, one from each
// end, that grow towards samples and towards each other. The first path that is found is taken.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "planning/ompl_search.h"
#include "planning/staged_search.h"

#include <ompl/geometric/planners/rrt/RRTConnect.h>

namespace {

constexpr double range_m =
    4.0;  // Longer steps are blocked more often, shorter ones cost iterations.

flyball::StageResult search(const flyball::SearchStage& stage, flyball::MotionChecker& checker) {
  using Planner = ompl::geometric::RRTConnect;
  // Each iteration draws one sample.
  return flyball::search_with_ompl<Planner>(
      stage, checker, [](Planner& planner) { planner.setRange(range_m); },
      [&stage](const Planner&, const flyball::PlanSampler& sampler) {
        return sampler.draws() >= stage.max_iterations;
      },
      [](const Planner&, const flyball::PlanSampler& sampler) { return sampler.draws(); });
}

class RrtConnect final : public flyball::PathPlanner {
 public:
  flyball::Plan plan(const flyball::PlanRequest& request,
                     const flyball::OccupancyView& map) override {
    return flyball::staged_plan(request, map, search);
  }
};

}  // namespace

FLYBALL_PLUGIN(rrt_connect) {
  registry.add<flyball::PathPlanner>("rrt_connect", [] { return std::make_unique<RrtConnect>(); });
}
