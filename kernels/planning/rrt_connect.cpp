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

constexpr double usual_range_m = 4.0;  // Chosen: longer steps are blocked more often.

flyball::StageResult search(double range_m,
                            const flyball::SearchStage& stage,
                            flyball::MotionChecker& checker) {
  using Planner = ompl::geometric::RRTConnect;
  // Each iteration draws one sample.
  return flyball::search_with_ompl<Planner>(
      stage, checker, [range_m](Planner& planner) { planner.setRange(range_m); },
      [&stage](const Planner&, const flyball::PlanSampler& sampler) {
        return sampler.draws() >= stage.max_iterations;
      },
      [](const Planner&, const flyball::PlanSampler& sampler) { return sampler.draws(); });
}

class RrtConnect final : public flyball::PathPlanner {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"range_m", usual_range_m, 0.1, 100.0,
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
          return search(range_m_, stage, checker);
        });
  }

 private:
  double range_m_{usual_range_m};
};

}  // namespace

FLYBALL_PLUGIN(rrt_connect) {
  registry.add<flyball::PathPlanner>("rrt_connect", [] { return std::make_unique<RrtConnect>(); });
}
