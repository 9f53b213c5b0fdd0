// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/path_planner_conformance.h"

#include "grid_map.h"
#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest planner whose plan is spoilt.
class PlannerCulprit final : public PathPlanner {
 public:
  explicit PlannerCulprit(std::string crime) : crime_{std::move(crime)} {}

  Plan plan(const PlanRequest& request, const OccupancyView& map) override {
    PlanRequest asked = request;
    if (crime_ == "greedy") {
      asked.max_iterations = 4 * request.max_iterations;
    } else if (crime_ == "long_winded") {
      asked.shorter_than_m = std::numeric_limits<double>::infinity();
      asked.max_iterations = 4000;
    } else if (crime_ == "remembers") {
      asked.seed += planned_++;
    }
    Plan plan = honest_->plan(asked, map);
    spoil(plan, request, map);
    return plan;
  }

 private:
  void spoil(Plan& plan, const PlanRequest& request, const OccupancyView& map) const {
    auto& points_W = plan.waypoints_W;
    if (crime_ == "ghost" || (crime_ == "credulous" && !plan.failure.empty())) {
      points_W = {request.start_W, request.goal_W};
      plan.failure.clear();
    } else if (crime_ == "hopeless" ||
               (crime_ == "timid" && map.state(request.goal_W) == CellState::unknown)) {
      points_W.clear();
      plan.failure = "goal blocked";
    } else if (crime_ == "mute") {
      plan.failure.clear();
    } else if (crime_ == "idle") {
      plan.work = {};
    } else if (crime_ == "shrinking") {
      plan.work = {};
      plan.work.add("iterations", 1e4 / request.max_iterations);
      plan.work.add("collision_queries", 1.0);
    } else if (!points_W.empty()) {
      spoil_path(points_W);
    }
  }
  void spoil_path(std::vector<Vec3>& points_W) const {
    const Vec3 second_W = points_W[1];
    if (crime_ == "elsewhere") {
      points_W.back().x() += 0.1;
    } else if (crime_ == "strays") {
      points_W.insert(points_W.begin() + 1, {second_W + Vec3{0, 50, 0}, second_W});
    } else if (crime_ == "steep") {
      points_W.insert(points_W.begin() + 1, points_W.front() + Vec3{0, 0, 0.5});
    }
  }

  std::string crime_;
  std::unique_ptr<PathPlanner> honest_{kit::kernels().make<PathPlanner>("rrt_connect")};
  std::uint64_t planned_{};
};

TEST(PathPlanners, keep_their_contract) {
  kit::try_all_registered<PathPlannerConformance, PathPlanner>();
}

TEST(PathPlanners, keep_their_contract_behind_a_knob_that_chooses_among_them) {
  const kit::GridMap map{{Vec3::Zero(), Vec3::Ones()}, 0.5, CellState::free};
  kit::try_all_behind_a_switch<PathPlannerConformance, PathPlanner, SwitchedPlanner>(
      [&map](PathPlanner& planner) { (void)planner.plan({}, map); });
}

TEST(PathPlannerConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<PathPlannerConformance, PathPlanner>(
      [](const std::string& crime) { return std::make_unique<PlannerCulprit>(crime); },
      {{"greedy", "takes more iterations than it may"},
       {"long_winded", "is longer than is wanted"},
       {"remembers", "plans differently after other plans"},
       {"ghost", "leads through an obstacle"},
       {"credulous", "plans from or to a place that is blocked"},
       {"hopeless", "finds no path where there is an easy one"},
       {"timid", "finds no path where there is an easy one"},
       {"mute", "neither finds a path nor says why"},
       {"idle", "counts no iterations"},
       {"shrinking", "counts less work for a larger input"},
       {"elsewhere", "does not lead from the start to the goal"},
       {"strays", "leaves the bounds"},
       {"steep", "is steeper than may be flown"}});
}

}  // namespace
}  // namespace flyball
