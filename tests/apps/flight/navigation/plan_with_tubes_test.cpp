// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_with_tubes.h"

#include "mission_rig.h"
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

kit::GridMap room_with_gap(double gap_m) {
  kit::GridMap map{{Vec3{-3, -3, 0}, Vec3{9, 3, 3}}, 0.15, CellState::free};
  map.fill({Vec3{3, -3, 0}, Vec3{3.15, -0.5 * gap_m, 3}}, CellState::occupied);
  map.fill({Vec3{3, 0.5 * gap_m, 0}, Vec3{3.15, 3, 3}}, CellState::occupied);
  return map;
}

/// Finds nothing, and counts how often it was asked, and for how many iterations.
class CountingPlanner final : public PathPlanner {
 public:
  std::vector<int> iterations{};
  Plan plan(const PlanRequest& request, const OccupancyView&) override {
    iterations.push_back(request.max_iterations);
    Plan none;
    none.failure = "none";
    none.work.add("tubes", 1.0);
    return none;
  }
};

struct Planning {
  explicit Planning(const kit::GridMap& map) : rig{map} {
    fly_within({Vec3{-2.5, -2.5, 1.0}, Vec3{8.5, 2.5, 1.6}});
    query.id = 1;
    query.start_W = Vec3{0, 0, 1.3};
    query.goal_W = Vec3{6, 1, 1.3};
  }
  void fly_within(const Aabb& bounds_W) { rig.brief->site.bounds_W = bounds_W; }
  Plan plan(Cylinder& body) { return plan_with_tubes(rig.situation(), *planner, query, body); }
  std::unique_ptr<PathPlanner> planner{Plugins{}.make<PathPlanner>("rrt_connect")};
  kit::MissionRig rig;
  PlanQuery query{};
};

TEST(PlanWithTubes, keeps_as_much_room_to_obstacles_as_there_is) {
  const std::array<double, 2> gaps_m{3.0, 1.5};
  const std::array<double, 2> rooms_m{0.6, 0.0};  // Around the tube of cruise speed.
  for (std::size_t i = 0; i < gaps_m.size(); ++i) {
    const kit::GridMap map = room_with_gap(gaps_m[i]);
    Planning planning{map};
    Cylinder body;
    const Plan plan = planning.plan(body);
    EXPECT_TRUE(plan.failure.empty()) << plan.failure;
    const double cruise_m_s = planning.rig.scenario.mission.max_speed_m_s;
    EXPECT_DOUBLE_EQ(body.radius_m, planning.rig.brief->body_at(cruise_m_s).radius_m + rooms_m[i]);
  }
}

TEST(PlanWithTubes, keeps_to_its_budget_where_there_is_no_path) {
  const kit::GridMap map = room_with_gap(0.0);
  Planning planning{map};
  ASSERT_TRUE(planning.rig.set("planner.budget", 1600));
  planning.query.may_be_tight = true;
  planning.query.failures = 5;
  Cylinder body;
  const Plan plan = planning.plan(body);
  EXPECT_TRUE(plan.waypoints_W.empty());
  EXPECT_LE(plan.work.count("iterations"), 1600.0);
  EXPECT_GT(plan.work.count("iterations"), 1500.0);
}

// What a wide tube gets was a share of the budget, so that a small budget meant narrow paths, which
// are flown slowly.
TEST(PlanWithTubes, searches_briefly_with_wide_tubes_and_longer_with_each_failure_in_narrow_ones) {
  const kit::GridMap map = room_with_gap(4.5);
  const auto iterations = [&map](int failures, double budget) {
    Planning planning{map};
    auto planner = std::make_unique<CountingPlanner>();
    const CountingPlanner& asked = *planner;
    planning.planner = std::move(planner);
    planning.query.goal_W.y() = 0.0;
    planning.query.failures = failures;
    EXPECT_TRUE(planning.rig.set("planner.budget", budget));
    Cylinder body;
    (void)planning.plan(body);
    return asked.iterations;
  };
  EXPECT_EQ(iterations(0, 4000), (std::vector<int>{500, 500, 1000}));
  EXPECT_EQ(iterations(1, 4000), (std::vector<int>{500, 500, 2000}));
  EXPECT_EQ(iterations(9, 4000), (std::vector<int>{500, 500, 4000}));
  EXPECT_EQ(iterations(1000, 1e6), (std::vector<int>{500, 500, 1000000}));
  EXPECT_EQ(iterations(1, 300), (std::vector<int>{300, 300, 300}));
}

TEST(PlanWithTubes, falls_back_to_the_narrow_tube_in_a_door) {
  const kit::GridMap map = room_with_gap(0.75);  // The middle tube's body measures .77 m.
  Planning planning{map};
  Cylinder body;
  const Plan plan = planning.plan(body);
  EXPECT_TRUE(plan.failure.empty()) << plan.failure;
  EXPECT_DOUBLE_EQ(body.radius_m, planning.rig.brief->body_at(1.0).radius_m);
  EXPECT_GT(plan.work.count("iterations"), 0.0);
}

// Half of the iterations would go to tubes that no opening lets through.
TEST(PlanWithTubes, spends_nothing_on_tubes_that_cannot_pass) {
  const auto iterations = [](double gap_m) {
    const kit::GridMap map = room_with_gap(gap_m);
    Planning planning{map};
    planning.planner = std::make_unique<CountingPlanner>();
    planning.query.goal_W.y() = 0.0;  // Square to the wall, as lines are that look for openings.
    Cylinder body;
    return planning.plan(body).work.count("tubes");
  };
  EXPECT_EQ(iterations(4.5), 3.0);
  EXPECT_EQ(iterations(0.45), 1.0);
}

// A wall of 9 m with a door of .75 m in its middle: around it is twice as far as through it.
TEST(PlanWithTubes, prefers_a_door_to_a_detour) {
  kit::GridMap map{{Vec3{-3, -10, 0}, Vec3{9, 10, 3}}, 0.15, CellState::free};
  map.fill({Vec3{3, -9, 0}, Vec3{3.15, -0.375, 3}}, CellState::occupied);
  map.fill({Vec3{3, 0.375, 0}, Vec3{3.15, 9, 3}}, CellState::occupied);
  Planning planning{map};
  planning.fly_within({Vec3{-2.5, -9.9, 1.0}, Vec3{8.5, 9.9, 1.6}});
  for (std::uint64_t id = 1; id <= 10; ++id) {
    planning.query.id = id;
    Cylinder body;
    const Plan plan = planning.plan(body);
    EXPECT_LT(length_m(plan.waypoints_W), 8.0) << id;
    EXPECT_DOUBLE_EQ(body.radius_m, planning.rig.brief->body_at(1.0).radius_m);
  }
}

// A tenth of these searches find one: a slow computer flies the detour sooner than it looks on.
TEST(PlanWithTubes, searches_for_a_shorter_path_no_longer_than_that_may_save) {
  kit::GridMap map{{Vec3{-3, -10, 0}, Vec3{9, 10, 3}}, 0.15, CellState::free};
  map.fill({Vec3{3, -9, 0}, Vec3{3.15, 9.3, 3}}, CellState::occupied);
  Planning planning{map};
  planning.fly_within({Vec3{-2.5, -9.9, 1.0}, Vec3{8.5, 9.9, 1.6}});
  const auto iterations = [&](double iteration_s) {
    planning.query.iteration_s = iteration_s;
    Cylinder body;
    const Plan plan = planning.plan(body);
    EXPECT_TRUE(plan.failure.empty()) << plan.failure;
    return plan.work.count("iterations");
  };
  const double bare = iterations(10.0);
  EXPECT_EQ(iterations(1e-9), bare + 400.0);
  EXPECT_GT(iterations(1e-3), bare);
  EXPECT_LT(iterations(1e-3), bare + 400.0);
}

// The line leads through the house: what is longer in metres takes less time.
TEST(PlanWithTubes, searches_for_no_shorter_path_than_one_that_takes_no_longer_than_the_line) {
  const auto iterations = [](double zone_m_s) {
    kit::GridMap map{{Vec3{-3, -10, 0}, Vec3{9, 10, 3}}, 0.15, CellState::free};
    map.fill({Vec3{3, -9, 0}, Vec3{3.15, 9.3, 3}}, CellState::occupied);
    Planning planning{map};
    planning.fly_within({Vec3{-2.5, -9.9, 1.0}, Vec3{8.5, 9.9, 1.6}});
    planning.rig.brief->site.zones = {{{Vec3{2.9, -1, 0}, Vec3{3.2, 1, 3}}, zone_m_s}};
    planning.query.start_W = Vec3{-2, 0, 1.3};
    planning.query.goal_W = Vec3{8, 0, 1.3};
    Cylinder body;
    return planning.plan(body).work.count("iterations");
  };
  EXPECT_EQ(iterations(100.0), iterations(0.02) + 400.0);
}

TEST(PlanWithTubes, reports_a_wall_without_a_gap) {
  const kit::GridMap map = room_with_gap(0.0);
  Planning planning{map};
  ASSERT_TRUE(planning.rig.set("planner.budget", 2000));
  Cylinder body;
  const Plan plan = planning.plan(body);
  EXPECT_TRUE(plan.waypoints_W.empty());
  EXPECT_FALSE(plan.failure.empty());
}

}  // namespace
}  // namespace flyball
