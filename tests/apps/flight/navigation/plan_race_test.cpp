// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_race.h"

#include "mission_rig.h"
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Each search ends after as many iterations as it is told, in the order in which they are asked;
/// none: it finds nothing. Ten queries come before and after a search, two with each iteration.
class ScriptedPlanner final : public PathPlanner {
 public:
  explicit ScriptedPlanner(std::vector<std::optional<int>> script) : script_{std::move(script)} {}

  Plan plan(const PlanRequest& request, const OccupancyView&) override {
    const std::optional<int> end = script_.at(asked.size());
    asked.push_back(request);
    const bool is_found = end && *end <= request.max_iterations;
    const double iterations = is_found ? *end : request.max_iterations;
    Plan plan;
    plan.work.add("iterations", iterations);
    plan.work.add("collision_queries", 10.0 + 2.0 * iterations);
    plan.searching.add("iterations", iterations);
    plan.searching.add("collision_queries", 2.0 * iterations);
    if (is_found) {  // The way says who went it.
      plan.waypoints_W = {Vec3::Zero(), Vec3::Constant(static_cast<double>(asked.size() - 1))};
    } else {
      plan.failure = "none";
    }
    return plan;
  }

  std::vector<PlanRequest> asked{};

 private:
  std::vector<std::optional<int>> script_;
};

struct Race {
  explicit Race(std::vector<std::optional<int>> script) : planner{script} {
    PlanRequest request;
    request.max_iterations = 3000;
    request.seed = 7;
    plan = race_of(static_cast<int>(script.size()), planner, request, map);
  }
  [[nodiscard]] double winner() const { return plan.waypoints_W.at(1).x(); }

  kit::GridMap map{{Vec3{-1, -1, -1}, Vec3{1, 1, 1}}, 0.5, CellState::free};
  ScriptedPlanner planner;
  Plan plan{};
};

TEST(PlanRace, is_won_by_the_search_with_the_fewest_iterations) {
  const Race race{{500, 120, std::nullopt}};
  EXPECT_EQ(race.winner(), 1.0);
  EXPECT_TRUE(race.plan.failure.empty());
}

TEST(PlanRace, is_won_by_the_first_of_those_that_end_together) {
  const Race race{{std::nullopt, 120, 120}};
  EXPECT_EQ(race.winner(), 1.0);
}

TEST(PlanRace, gives_each_search_draws_of_its_own_and_an_equal_part_of_the_budget) {
  const Race race{{500, 120, 300}};
  ASSERT_EQ(race.planner.asked.size(), 3U);
  EXPECT_EQ(race.planner.asked[0].seed, 7U);
  EXPECT_NE(race.planner.asked[1].seed, race.planner.asked[2].seed);
  for (const PlanRequest& request : race.planner.asked) {
    EXPECT_EQ(request.max_iterations, 1000);
  }
}

TEST(PlanRace, costs_what_all_searches_do_until_its_end_and_shares_only_that) {
  const Race race{{500, 120, std::nullopt}};
  EXPECT_DOUBLE_EQ(race.plan.work.count("iterations"), 3 * 120.0);
  EXPECT_DOUBLE_EQ(race.plan.work.count("collision_queries"), 10.0 + 3 * 240.0);
  ASSERT_TRUE(race.plan.work.tells_shared());
  EXPECT_DOUBLE_EQ(race.plan.work.shared().count("iterations"), 3 * 120.0);
  EXPECT_DOUBLE_EQ(race.plan.work.shared().count("collision_queries"), 3 * 240.0);
}

TEST(PlanRace, costs_the_whole_budget_where_nobody_finds_a_path) {
  const Race race{{std::nullopt, std::nullopt, std::nullopt}};
  EXPECT_FALSE(race.plan.failure.empty());
  EXPECT_DOUBLE_EQ(race.plan.work.shared().count("iterations"), 3000.0);
}

TEST(PlanRace, is_not_held_where_nothing_is_searched_for) {
  const Race race{{0, 0, 0}};
  EXPECT_EQ(race.planner.asked.size(), 1U);
  EXPECT_DOUBLE_EQ(race.plan.work.count("collision_queries"), 10.0);
  ASSERT_TRUE(race.plan.work.tells_shared());
  EXPECT_EQ(race.plan.work.shared().count("collision_queries"), 0.0) << "one core does it all";
}

TEST(PlanRace, of_one_is_the_plan_itself) {
  const Race race{{500}};
  ASSERT_EQ(race.planner.asked.size(), 1U);
  EXPECT_EQ(race.planner.asked[0].max_iterations, 3000);
  EXPECT_DOUBLE_EQ(race.plan.work.count("collision_queries"), 1010.0);
  EXPECT_FALSE(race.plan.work.tells_shared());
}

}  // namespace
}  // namespace flyball
