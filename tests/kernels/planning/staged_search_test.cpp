// SPDX-License-Identifier: BSD-3-Clause
#include "planning/staged_search.h"

#include "plan_scenes.h"
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace {

using flyball::MotionChecker;
using flyball::PlanRequest;
using flyball::SearchStage;
using flyball::StageResult;
using flyball::Vec3;

PlanRequest long_path() {
  PlanRequest request;
  request.start_W = {0, 0, 1.5};
  request.goal_W = {50, 10, 1.5};
  request.bounds_W = {{-200, -100, 0.5}, {200, 100, 4.0}};
  request.body = flyball::kit::slow_body();
  request.max_iterations = 1000;
  return request;
}

TEST(StagedSearch, widens_its_box_and_spends_all_iterations) {
  const auto stages = flyball::search_stages(long_path());
  ASSERT_EQ(stages.size(), 3U);
  EXPECT_EQ(stages[0].box_W.min, (Vec3{-8, -8, 0.5}));
  EXPECT_EQ(stages[0].box_W.max, (Vec3{58, 18, 4.0}));
  EXPECT_EQ(stages[1].box_W.max, (Vec3{70, 30, 4.0}));
  EXPECT_EQ(stages[2].box_W.max, (Vec3{200, 100, 4.0}));
  EXPECT_EQ(stages[0].max_iterations, 250);
  EXPECT_EQ(stages[1].max_iterations, 250);
  EXPECT_EQ(stages[2].max_iterations, 500);
  EXPECT_NE(stages[0].seed, stages[1].seed);
}

TEST(StagedSearch, leaves_out_boxes_that_are_no_smaller_than_the_bounds) {
  PlanRequest request = long_path();
  request.bounds_W = {{-5, -5, 0.5}, {55, 15, 4.0}};
  const auto stages = flyball::search_stages(request);
  ASSERT_EQ(stages.size(), 1U);
  EXPECT_EQ(stages[0].max_iterations, 1000);
}

TEST(StagedSearch, looks_for_shorter_paths_only_where_they_can_be) {
  PlanRequest request = long_path();
  request.goal_W = {40, 0, 1.5};
  request.shorter_than_m = 50;  // half axes of the ellipse: 25 m and 15 m
  const auto stages = flyball::search_stages(request);
  ASSERT_EQ(stages.size(), 1U);
  EXPECT_EQ(stages[0].box_W.min, (Vec3{-15, -15, 0.5}));
  EXPECT_EQ(stages[0].box_W.max, (Vec3{55, 15, 4.0}));
  EXPECT_EQ(stages[0].max_iterations, 1000);
  EXPECT_EQ(stages[0].shorter_than_m, 50);
}

TEST(StagedSearch, refuses_a_path_that_is_not_shorter_than_wanted) {
  auto scene = flyball::kit::random_world(1);
  scene.request.start_W = {1, 0, 1.5};
  scene.request.goal_W = {1, 6, 1.5};
  scene.request.shorter_than_m = 5.9;
  const auto search = [](const SearchStage&, MotionChecker&) { return StageResult{}; };
  EXPECT_EQ(flyball::staged_plan(scene.request, scene.map, search).failure,
            "no path shorter than 5.9 m");
  scene.request.shorter_than_m = 6.1;
  EXPECT_EQ(flyball::staged_plan(scene.request, scene.map, search).waypoints_W.size(), 2U);
}

TEST(StagedSearch, lets_a_vehicle_start_that_has_drifted_out_of_bounds) {
  PlanRequest request = long_path();
  request.start_W = {0, 0, 4.1};
  for (const SearchStage& stage : flyball::search_stages(request)) {
    EXPECT_TRUE(stage.box_W.contains(request.start_W));
    EXPECT_TRUE(stage.box_W.contains(request.goal_W));
  }
}

TEST(StagedSearch, goes_on_until_a_stage_succeeds_and_adds_up_the_work) {
  const auto scene = flyball::kit::office(0, 2);
  std::vector<int> asked;
  const auto plan = flyball::staged_plan(
      scene.request, scene.map, [&](const SearchStage& stage, MotionChecker& checker) {
        asked.push_back(stage.max_iterations);
        EXPECT_FALSE(checker.is_flyable(stage.start_W, stage.goal_W));
        return StageResult{{}, 7, {}};
      });
  EXPECT_EQ(asked.size(), flyball::search_stages(scene.request).size());
  EXPECT_EQ(plan.failure, "no path within 40000 iterations");
  EXPECT_EQ(plan.work.count("iterations"), 7.0 * static_cast<double>(asked.size()));
  EXPECT_GE(plan.work.count("collision_queries"), static_cast<double>(asked.size()));
}

TEST(StagedSearch, hands_on_what_broke_a_search) {
  const auto scene = flyball::kit::office(0, 2);
  const auto plan =
      flyball::staged_plan(scene.request, scene.map, [](const SearchStage&, MotionChecker&) {
        return StageResult{{}, 3, "planner broke down"};
      });
  EXPECT_TRUE(plan.waypoints_W.empty());
  EXPECT_EQ(plan.failure, "planner broke down");
  EXPECT_EQ(plan.work.count("iterations"), 3.0);
}

TEST(StagedSearch, starts_from_a_place_that_is_within_its_own_margin_of_a_wall) {
  flyball::kit::GridMap map{{{0, -5, 0}, {20, 5, 3}}, 0.15};
  map.fill({{10.05, -5, 0}, {10.2, 5, 3}}, flyball::CellState::occupied);
  PlanRequest request;
  request.body = flyball::kit::slow_body();
  request.start_W = {10.05 - request.body.radius_m - 0.001, 0, 1.5};
  request.goal_W = {2, 0, 1.5};
  request.bounds_W = {{0, -5, 0}, {20, 5, 3}};
  const auto plan = flyball::staged_plan(
      request, map, [](const SearchStage&, MotionChecker&) { return StageResult{}; });
  EXPECT_EQ(plan.waypoints_W.size(), 2U);
}

/// Around the end of a wall, which stands between start and goal.
struct FlownScene {
  explicit FlownScene(double end_y_m = 2.0) {
    map.fill({{10.0, -5, 0}, {10.15, end_y_m, 3}}, flyball::CellState::occupied);
    request.body = flyball::kit::slow_body();
    request.start_W = {2, 0, 1.5};
    request.goal_W = {18, 0, 1.5};
    request.bounds_W = {{0, -5, 0}, {20, 5, 3}};
    for (int i = 0; i <= 160; ++i) {
      const double x = 2.0 + 0.1 * i;
      request.flown_W.push_back({x, 4.0 * (1.0 - std::abs(x - 10.0) / 8.0), 1.5});
    }
  }
  /// Searches that the plan took.
  int searches() {
    int count = 0;
    plan = flyball::staged_plan(request, map, [&count](const SearchStage&, MotionChecker&) {
      ++count;
      return StageResult{};
    });
    return count;
  }
  flyball::kit::GridMap map{{{0, -5, 0}, {20, 5, 3}}, 0.15};
  PlanRequest request;
  flyball::Plan plan;
};

TEST(StagedSearch, takes_the_way_that_was_flown_with_few_way_points) {
  FlownScene scene;
  EXPECT_EQ(scene.searches(), 0);
  ASSERT_GE(scene.plan.waypoints_W.size(), 3U);
  EXPECT_LE(scene.plan.waypoints_W.size(), 4U);
  EXPECT_EQ(scene.plan.waypoints_W.front(), scene.request.start_W);
  EXPECT_EQ(scene.plan.waypoints_W.back(), scene.request.goal_W);
  EXPECT_EQ(scene.plan.work.count("iterations"), 0.0);
  EXPECT_LT(scene.plan.work.count("collision_queries"), 200.0);
  for (std::size_t i = 1; i < scene.plan.waypoints_W.size(); ++i) {
    EXPECT_FALSE(scene.map.segment_hits(scene.plan.waypoints_W[i - 1], scene.plan.waypoints_W[i],
                                        scene.request.body));
  }
}

TEST(StagedSearch, searches_where_the_way_that_was_flown_is_blocked_now) {
  FlownScene scene{4.5};
  EXPECT_GT(scene.searches(), 0);
  EXPECT_FALSE(scene.plan.failure.empty());
}

TEST(StagedSearch, searches_where_a_shorter_path_is_wanted_than_was_flown) {
  FlownScene scene;
  scene.request.shorter_than_m = 17.0;
  EXPECT_GT(scene.searches(), 0);
}

TEST(StagedSearch, searches_where_the_way_that_was_flown_leaves_the_bounds) {
  FlownScene scene;
  scene.request.bounds_W.max.y() = 3.5;
  EXPECT_GT(scene.searches(), 0);
}

}  // namespace
