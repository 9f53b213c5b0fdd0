// SPDX-License-Identifier: BSD-3-Clause
// flyball-link: flyball_ompl
//
// RRT* (Karaman and Frazzoli 2011, doi:10.1177/0278364911406761): one tree that is rewired towards
// shorter paths. After the first path it improves for as many iterations again, and a few more.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "planning/improving_stop.h"
#include "planning/ompl_search.h"
#include "planning/staged_search.h"

#include <ompl/geometric/planners/rrt/RRTstar.h>

namespace {

constexpr double usual_star_range_m = 4.0;  // That of rrt_connect.

flyball::StageResult search_star(double range_m,
                                 const flyball::SearchStage& stage,
                                 flyball::MotionChecker& checker) {
  using Planner = ompl::geometric::RRTstar;
  return flyball::search_with_ompl<Planner>(
      stage, checker, [range_m](Planner& planner) { planner.setRange(range_m); },
      flyball::ImprovingStop{stage.max_iterations},
      [](const Planner& planner, const flyball::PlanSampler&) {
        return static_cast<int>(planner.numIterations());
      });
}

class RrtStar final : public flyball::PathPlanner {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"range_m", usual_star_range_m, 0.1, 100.0,
             "longest step: longer ones are blocked more often, shorter ones cost iterations"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    range_m_ = chosen.number("range_m");
    return flyball::Done{};
  }

  flyball::Plan plan(const flyball::PlanRequest& request,
                     const flyball::OccupancyView& map) override {
    return flyball::staged_plan(
        request, map, [this](const flyball::SearchStage& stage, flyball::MotionChecker& checker) {
          return search_star(range_m_, stage, checker);
        });
  }

 private:
  double range_m_{usual_star_range_m};
};

}  // namespace

FLYBALL_PLUGIN(rrt_star) {
  registry.add<flyball::PathPlanner>("rrt_star", [] { return std::make_unique<RrtStar>(); });
}
