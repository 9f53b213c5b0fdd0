// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigator.h"

#include "navigator_trip.h"
#include <optional>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::Trip;

const Vec3 away_W{20, 0, 1.5};

Scenario with_horizon(double horizon_m) {
  Scenario scenario = kit::MissionRig::one_core();
  scenario.planner.horizon_m = horizon_m;
  return scenario;
}

/// What is asked for on the way home.
std::optional<PlanQuery> homebound(Trip& trip) {
  const Vec3 home_W = trip.navigator.follower().position_W();
  trip.set_goal(away_W);
  const auto out = trip.navigator.next_query(trip.now);
  EXPECT_TRUE(out && out->flown_W.empty()) << "nobody has been there";
  trip.answer(*out);
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
  trip.hover_at(away_W);
  trip.set_goal(home_W);
  return trip.navigator.next_query(trip.now);
}

TEST(NavigatorReturns, tells_the_planner_of_the_way_by_which_it_came) {
  Trip trip{with_horizon(30.0)};
  const auto query = homebound(trip);
  ASSERT_TRUE(query);
  ASSERT_GT(query->flown_W.size(), 100U);
  EXPECT_EQ(query->flown_W.front(), query->start_W);
  EXPECT_LT((query->flown_W.back() - query->goal_W).norm(), 0.2);
}

TEST(NavigatorReturns, tells_no_more_of_the_way_than_a_plan_can_use) {
  Trip trip{with_horizon(10.0)};
  const auto query = homebound(trip);
  ASSERT_TRUE(query);
  EXPECT_NEAR((query->flown_W.back() - query->start_W).norm(), 10.0, 0.2);
}

TEST(NavigatorReturns, searches_for_a_shorter_path_in_open_space_until_a_search_fails) {
  Trip trip;
  auto query = homebound(trip);
  ASSERT_TRUE(query);
  EXPECT_TRUE(query->flown_W.empty());
  for (const bool has_way : {true, false, true}) {  // The way itself may be what fails.
    trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
    trip.tick(100);
    query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query);
    EXPECT_EQ(!query->flown_W.empty(), has_way);
  }
}

TEST(NavigatorReturns, forgets_the_way_where_that_leads_no_nearer) {
  Trip trip{with_horizon(30.0)};
  auto query = homebound(trip);
  const MissionTime before = trip.now;
  ASSERT_TRUE(query);
  EXPECT_FALSE(query->flown_W.empty());
  while (to_seconds(trip.now - before) < 120.0) {  // Nearer for none of 90 s.
    trip.answer(*query);
    trip.tick(10);
    trip.block(0.5);
    query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query);
    trip.tick(1000);
  }
  EXPECT_TRUE(query->flown_W.empty());
}

TEST(NavigatorReturns, knows_the_way_home_also_after_another_goal) {
  Trip trip{with_horizon(30.0)};
  const Vec3 home_W = trip.navigator.follower().position_W();
  ASSERT_TRUE(homebound(trip));
  trip.set_goal(Vec3{30, 0, 1.5});
  const auto on = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(on);
  EXPECT_TRUE(on->flown_W.empty());
  trip.answer(*on);
  trip.tick(2000);
  trip.set_goal(home_W);
  const auto back = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(back);
  EXPECT_GT((back->flown_W.front() - back->flown_W.back()).norm(), 28.0);
}

}  // namespace
}  // namespace flyball
