// SPDX-License-Identifier: BSD-3-Clause
// flyball-link: flyball_ompl
//
// RRT (LaValle 1998, technical report TR 98-11): one tree from the start, that now and then grows
// straight towards the goal. The first path that is found is taken.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "planning/ompl_search.h"
#include "planning/staged_search.h"
#include <algorithm>

#include <ompl/geometric/planners/rrt/RRT.h>

namespace {

struct Settings {
  double range_m{4.0};     ///< That of rrt_connect.
  double goal_bias{0.05};  ///< OMPL's default.
};

flyball::StageResult search(const Settings& settings,
                            const flyball::SearchStage& stage,
                            flyball::MotionChecker& checker) {
  using Planner = ompl::geometric::RRT;
  // An iteration that aims at the goal draws no sample, so the questions are counted: one for each.
  int asked = 0;
  return flyball::search_with_ompl<Planner>(
      stage, checker,
      [&settings](Planner& planner) {
        planner.setRange(settings.range_m);
        planner.setGoalBias(settings.goal_bias);
      },
      [&](const Planner&, const flyball::PlanSampler&) { return asked++ >= stage.max_iterations; },
      [&](const Planner&, const flyball::PlanSampler&) {
        return std::min(asked, stage.max_iterations);
      });
}

class Rrt final : public flyball::PathPlanner {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    const Settings usual;
    return {
        {"range_m", usual.range_m, 0.1, 100.0,
         "longest step: longer ones are blocked more often, shorter ones cost iterations"},
        {"goal_bias", usual.goal_bias, 0.0, 1.0, "share of the iterations that aim at the goal"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    settings_ = {chosen.number("range_m"), chosen.number("goal_bias")};
    return flyball::Done{};
  }

  flyball::Plan plan(const flyball::PlanRequest& request,
                     const flyball::OccupancyView& map) override {
    return flyball::staged_plan(
        request, map, [this](const flyball::SearchStage& stage, flyball::MotionChecker& checker) {
          return search(settings_, stage, checker);
        });
  }

 private:
  Settings settings_{};
};

}  // namespace

FLYBALL_PLUGIN(rrt) {
  registry.add<flyball::PathPlanner>("rrt", [] { return std::make_unique<Rrt>(); });
}
