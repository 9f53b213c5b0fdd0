// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "plan_scenes.h"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

using flyball::Plan;
using flyball::PlanRequest;
using flyball::Vec3;
using flyball::kit::GridMap;
using flyball::kit::Scene;

std::unique_ptr<flyball::PathPlanner> planner(const std::string& name) {
  flyball::Registry registry;
  flyball::register_kernels(registry);
  auto made = registry.make<flyball::PathPlanner>(name);
  EXPECT_TRUE(made) << name;
  return made;
}

void expect_sound(const Plan& plan, const Scene& scene) {
  const auto& points = plan.waypoints_W;
  ASSERT_GE(points.size(), 2U) << plan.failure;
  EXPECT_EQ(points.front(), scene.request.start_W);
  EXPECT_EQ(points.back(), scene.request.goal_W);
  EXPECT_TRUE(plan.failure.empty());
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 piece = points[i + 1] - points[i];
    EXPECT_FALSE(scene.map.segment_hits(points[i], points[i + 1], scene.request.body)) << i;
    EXPECT_TRUE(scene.request.bounds_W.contains(points[i])) << points[i].transpose();
    if (piece.norm() >= 0.3) {
      EXPECT_LE(std::atan2(std::abs(piece.z()), piece.head<2>().norm()),
                scene.request.max_slope_rad + 1e-6);
    }
  }
}

class Rrt : public testing::TestWithParam<std::string> {};

TEST_P(Rrt, flies_straight_where_nothing_is_in_the_way_and_pays_one_motion_query) {
  Scene scene{GridMap{{{0, -5, 0}, {20, 5, 3}}, 0.15}, {}};
  scene.request.start_W = {2, 0, 1.5};
  scene.request.goal_W = {18, 1, 1.2};
  scene.request.bounds_W = {{0, -5, 0}, {20, 5, 3}};
  scene.request.body = flyball::kit::slow_body();
  const Plan plan = planner(GetParam())->plan(scene.request, scene.map);
  expect_sound(plan, scene);
  EXPECT_EQ(plan.waypoints_W.size(), 2U);
  EXPECT_EQ(plan.work.count("iterations"), 0.0);
  EXPECT_LE(plan.work.count("collision_queries"), 5.0);
}

TEST_P(Rrt, finds_flyable_paths_in_random_worlds) {
  const auto rrt = planner(GetParam());
  int found = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Scene scene = flyball::kit::random_world(seed);
    scene.request.max_iterations = 4000;
    const Plan plan = rrt->plan(scene.request, scene.map);
    if (plan.waypoints_W.empty()) {
      EXPECT_EQ(plan.failure, "no path within 4000 iterations");
      continue;
    }
    ++found;
    expect_sound(plan, scene);
  }
  EXPECT_GE(found, 48);
}

TEST_P(Rrt, gives_the_same_plan_first_and_after_others) {
  const auto rrt = planner(GetParam());
  Scene scene = flyball::kit::random_world(7);
  scene.request.max_iterations = 3000;
  const Plan first = rrt->plan(scene.request, scene.map);
  ASSERT_GT(first.work.count("iterations"), 0.0);
  for (std::uint64_t seed = 20; seed < 25; ++seed) {
    Scene other = flyball::kit::random_world(seed);
    other.request.max_iterations = 1000;
    (void)rrt->plan(other.request, other.map);
  }
  const Plan again = rrt->plan(scene.request, scene.map);
  EXPECT_EQ(again.waypoints_W, first.waypoints_W);
  EXPECT_EQ(again.work.count("iterations"), first.work.count("iterations"));
  EXPECT_EQ(again.work.count("collision_queries"), first.work.count("collision_queries"));
  scene.request.seed += 1;
  EXPECT_NE(rrt->plan(scene.request, scene.map).waypoints_W, first.waypoints_W);
}

TEST_P(Rrt, says_why_there_is_no_plan) {
  const auto rrt = planner(GetParam());
  Scene scene = flyball::kit::office(0, 1);
  scene.request.max_iterations = 300;
  const auto failure = [&](const PlanRequest& request) {
    const Plan plan = rrt->plan(request, scene.map);
    EXPECT_TRUE(plan.waypoints_W.empty());
    return plan.failure;
  };
  PlanRequest blocked = scene.request;
  blocked.start_W.x() = 10.1;
  blocked.start_W.y() = 12.0;
  EXPECT_EQ(failure(blocked), "start blocked");
  blocked = scene.request;
  blocked.goal_W = {10.1, 12.0, 1.5};
  EXPECT_EQ(failure(blocked), "goal blocked");
  blocked.goal_W = {100.0, 0.0, 1.5};
  EXPECT_EQ(failure(blocked), "goal blocked");
  scene.map.fill({{10.05, -15, 0}, {10.2, 15, 3}}, flyball::CellState::occupied);  // no door
  const Plan plan = rrt->plan(scene.request, scene.map);
  EXPECT_EQ(plan.failure, "no path within 300 iterations");
  EXPECT_EQ(plan.work.count("iterations"), 300.0);
  EXPECT_GT(plan.work.count("collision_queries"), 300.0);
}

INSTANTIATE_TEST_SUITE_P(Planners,
                         Rrt,
                         testing::Values("rrt", "rrt_connect", "rrt_star", "prm", "bit_star"),
                         [](const auto& one) { return one.param; });

// A .71 m body through .75 m doors: ± 2 cm.
TEST(RrtConnect, passes_narrow_doors_in_a_few_hundred_iterations) {
  const auto rrt = planner("rrt_connect");
  for (const int known_doors : {0, 1, 3}) {
    std::vector<double> iterations;
    std::vector<double> queries;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Scene scene = flyball::kit::office(known_doors, seed);
      const Plan plan = rrt->plan(scene.request, scene.map);
      expect_sound(plan, scene);
      iterations.push_back(plan.work.count("iterations"));
      queries.push_back(plan.work.count("collision_queries"));
    }
    std::sort(iterations.begin(), iterations.end());
    std::sort(queries.begin(), queries.end());
    const std::string prefix = std::to_string(known_doors) + "_more_doors_";
    RecordProperty(prefix + "median_iterations", std::to_string(iterations[5]));
    RecordProperty(prefix + "max_iterations", std::to_string(iterations.back()));
    RecordProperty(prefix + "median_queries", std::to_string(queries[5]));
    EXPECT_LT(iterations[5], 1000.0) << known_doors;
    EXPECT_LT(iterations.back(), 5000.0) << known_doors;
  }
}

}  // namespace
