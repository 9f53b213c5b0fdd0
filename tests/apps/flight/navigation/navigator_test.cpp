// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigator.h"

#include "flyball/flight/navigation/sub_goal.h"

#include "navigator_trip.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using kit::along;
using kit::detour;
using kit::GridMap;
using kit::straight;
using kit::Trip;

TEST(Navigator, asks_for_one_plan_per_goal_and_arrives) {
  Trip trip;
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
  trip.set_goal(Vec3{20, 0, 1.5});
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());  // One at a time.
  trip.answer(*query);
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
}

// Governors compare its latency with what such a map was expected to take.
TEST(Navigator, tells_of_one_map_with_its_range_and_latency) {
  const kit::GridMap map{{Vec3{-1, -1, 0}, Vec3{1, 1, 1}}, 0.5, CellState::free};
  kit::MissionRig rig{map};
  Navigator navigator{rig.brief, rig.kernels.path_tracker};
  navigator.set_knobs(MissionTime{1s}, rig.knobs);
  EXPECT_EQ(navigator.state().map, nullptr);
  EXPECT_EQ(navigator.state().map_range_m, 0.0);
  PathClearance clearance;
  clearance.revision = {7, MissionTime{1s}, 0.5, std::make_shared<const kit::GridMap>(map), 4.0};
  clearance.published = MissionTime{1200ms};
  navigator.path_checked(MissionTime{1300ms}, clearance);
  const NavigatorState told = navigator.state();
  EXPECT_EQ(told.map, clearance.revision.map);
  EXPECT_EQ(told.map_range_m, 4.0);
  EXPECT_EQ(told.map_latency, 200ms);
}

TEST(Navigator, has_arrived_where_a_path_ends_within_the_tolerance_of_the_goal) {
  for (const double tolerance_m : {0.3, 1.5}) {
    Scenario scenario = kit::MissionRig::one_core();
    scenario.mission.goal_tolerance_m = tolerance_m;
    Trip trip{scenario};
    trip.set_goal(Vec3{20, 0, 1.5});
    auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    query->goal_W.x() -= 1.0;  // The plan ends 1 m short of the goal.
    trip.answer(*query);
    trip.tick(2000);
    const bool is_near_enough = tolerance_m > 1.0;
    EXPECT_EQ(trip.navigator.has_arrived(), is_near_enough);
    EXPECT_EQ(trip.navigator.next_query(trip.now).has_value(), !is_near_enough);
  }
}

TEST(Navigator, reaches_a_far_goal_through_intermediate_places) {
  Scenario scenario = kit::MissionRig::one_core();
  scenario.planner.horizon_m = 20.0;
  Site site;
  site.bounds_W = {Vec3{-2, -3, 0}, Vec3{60, 3, 3}};
  Trip trip{scenario, site};
  trip.set_goal(Vec3{50, 0, 1.5});
  double least_m_s = 10.0;
  int plans = 0;
  for (int i = 0; i < 3000 && !trip.navigator.has_arrived(); ++i) {
    if (auto query = trip.navigator.next_query(trip.now)) {
      query->goal_W =  // As the node `plan` does.
          sub_goal_W(trip.rig.situation(), query->start_W, query->goal_W, query->failures);
      EXPECT_LE((query->goal_W - query->start_W).norm(), 20.0 + 1e-9);
      ++plans;
      trip.answer(*query);
    }
    trip.tick(1);
    const double x_m = trip.navigator.follower().position_W().x();
    if (x_m > 10.0 && x_m < 40.0) {
      least_m_s = std::min(least_m_s, trip.navigator.follower().speed_m_s());
    }
  }
  EXPECT_TRUE(trip.navigator.has_arrived());
  EXPECT_GE(plans, 3);
  EXPECT_LE(plans, 8);
  EXPECT_GT(least_m_s, 1.0) << "it does not stop between two legs";
}

TEST(Navigator,
     plans_from_a_point_ahead_when_its_path_is_blocked_and_stops_there_if_no_answer_comes) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  const auto first = trip.navigator.next_query(trip.now);
  trip.answer(*first);
  trip.tick(100);
  const double x = trip.navigator.follower().position_W().x();
  trip.block(25.0);
  const auto second = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(second.has_value());
  EXPECT_GT(second->start_W.x(), x);
  EXPECT_NEAR(second->start_direction_W.x(), 1.0, 1e-6);
  trip.tick(1000);
  // The plan would have been flown into; without it the vehicle stands where a stop ends.
  EXPECT_GE(trip.navigator.follower().position_W().x(), second->start_W.x());
  EXPECT_LT(trip.navigator.follower().position_W().x(), 25.0);
  EXPECT_LT(trip.navigator.follower().speed_m_s(), 0.02);
}

TEST(Navigator, plans_from_its_stop_after_a_plan_that_came_too_late) {
  Trip trip;
  const auto late = trip.fly_until_blocked();
  trip.tick(200);
  trip.answer(*late);
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  EXPECT_NEAR(again->start_W.x(), trip.navigator.follower().position_W().x(), 0.02);
}

// It creeps on with each cell that becomes known, and was beyond every splice where it stood.
TEST(Navigator, adopts_the_first_plan_where_it_stands_before_unknown_space) {
  Trip trip;
  trip.map.fill({Vec3{5, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.set_goal(Vec3{40, 0, 1.5});
  const auto first = trip.navigator.next_query(trip.now);
  trip.answer(*first);
  trip.tick(500);
  ASSERT_LT(trip.navigator.follower().speed_m_s(), 0.05);
  const double stands_at_m = trip.navigator.follower().position_W().x();
  trip.block(5.0);
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.map.fill({Vec3{5, -3, 0}, Vec3{5.15, 3, 3}}, CellState::free);
  trip.tick(100);
  EXPECT_NEAR(trip.navigator.follower().position_W().x(), stands_at_m, 0.01) << "it waits";
  const auto number = trip.navigator.state().path_number;
  trip.answer(*query);
  EXPECT_EQ(trip.navigator.state().path_number, number + 1);
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "it was adopted";
}

/// Its path is blocked; the new one is longer by `detour_m`.
void replan(Trip& trip, double detour_m) {
  trip.block(12.0);
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.navigator.path_planned(trip.now,
                              {query->id, detour(query->start_W, query->goal_W, detour_m), ""});
}

TEST(Navigator, flies_a_longer_path_at_once) {
  Trip trip;
  trip.set_goal(Vec3{20, 0, 1.5});
  replan(trip, 0.0);
  trip.tick(50);
  const auto number = trip.navigator.state().path_number;
  replan(trip, 18.0);
  EXPECT_EQ(trip.navigator.state().path_number, number + 1);
}

TEST(Navigator, flies_on_through_what_is_free_while_a_plan_around_something_far_ahead_is_made) {
  Trip trip;
  trip.turn("mission.max_speed_m_s", 4.0);
  trip.set_goal(Vec3{40, 0, 1.5});
  const auto first = trip.navigator.next_query(trip.now);
  trip.answer(*first);
  trip.tick(100);
  const double cruise_m_s = trip.navigator.follower().speed_m_s();
  const double x_m = trip.navigator.follower().position_W().x();
  trip.block(x_m + 12.0);
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.tick(50);  // A second, in which it would have come to rest.
  EXPECT_GT(trip.navigator.follower().speed_m_s(), 0.9 * cruise_m_s);
  trip.tick(1000);
  EXPECT_LT(trip.navigator.follower().speed_m_s(), 0.02);
  EXPECT_LE(trip.navigator.follower().position_W().x(), x_m + 12.0 - 3.0) << "room to turn";
  EXPECT_GT(trip.navigator.follower().position_W().x(), x_m + 12.0 - 4.0);
}

TEST(Navigator, lets_the_next_path_begin_at_its_stop_when_it_was_too_fast_for_the_last) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  replan(trip, 0.0);
  trip.tick(100);
  trip.block(12.0);
  const auto first = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(first.has_value());
  const Vec3 aside_W = first->start_W + Vec3{0, 3, 0};
  trip.navigator.path_planned(trip.now,
                              {first->id, along({first->start_W, aside_W, first->goal_W}), ""});
  const auto second = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(second.has_value());
  EXPECT_FALSE(second->may_turn_back) << "another search takes less time than turning";
  EXPECT_GT(second->start_W.x(), first->start_W.x() + 0.3);
  trip.tick(400);
  EXPECT_NEAR(trip.navigator.follower().position_W().x(), second->start_W.x(), 0.1);
}

TEST(Navigator, may_turn_back_to_a_known_path_where_it_is_slow) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  EXPECT_TRUE(query->may_turn_back);
}

TEST(Navigator, calls_the_place_clear_where_it_rests_when_a_plan_cannot_begin_there) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  for (const char* why : {"no path", "start blocked"}) {
    EXPECT_TRUE(trip.declared_W.empty());
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.tick(60);
    trip.navigator.path_planned(trip.now, {query->id, {}, why});
    trip.tick(60);
  }
  ASSERT_EQ(trip.declared_W.size(), 1U);
  EXPECT_LT((trip.declared_W[0] - Vec3{0, 0, 1.5}).norm(), 1e-9);
}

TEST(Navigator, steps_out_of_what_reaches_into_its_tube_when_a_plan_cannot_begin_there) {
  Trip trip;
  const double radius_m = trip.rig.brief->narrow_body().radius_m;
  // The cell's border is a centimetre inside of the tube.
  const double inside_m = 0.01;
  trip.hover_at(Vec3{0, 3.0 - 0.15 - radius_m + inside_m, 1.5});
  trip.map.fill({Vec3{-2, 2.85, 0}, Vec3{60, 3, 3}}, CellState::occupied);
  trip.set_goal(Vec3{40, 0, 1.5});
  trip.tick(60);
  const Cylinder body = trip.rig.brief->narrow_body();
  const Vec3 before_W = trip.navigator.follower().position_W();
  ASSERT_EQ(trip.map.body_state(before_W, body), CellState::occupied);
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.navigator.path_planned(trip.now, {query->id, {}, "start blocked"});
  trip.tick(60);
  const Vec3 after_W = trip.navigator.follower().position_W();
  EXPECT_NE(trip.map.body_state(after_W, body), CellState::occupied);
  EXPECT_LT((after_W - before_W).norm(), 0.031);
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  EXPECT_LT((again->start_W - after_W).norm(), 1e-9);
}

/// Flies towards a goal where it is to look along `yaw_rad`, until cells fill the place where it
/// stands and no plan can begin.
void expect_it_goes_back(const std::optional<double>& yaw_rad) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5}, yaw_rad);
  const auto there = trip.navigator.next_query(trip.now);
  trip.answer(*there);
  trip.tick(100);
  trip.block(25.0);
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.tick(1000);  // It stands.
  const Vec3 before_W = trip.navigator.follower().position_W();
  trip.map.fill({before_W - Vec3{0.1, 3.0, 1.0}, Vec3{60, 3, 3}}, CellState::occupied);
  trip.tick(5);
  trip.navigator.path_planned(trip.now, {query->id, {}, "start blocked"});
  trip.tick(200);
  const Vec3 after_W = trip.navigator.follower().position_W();
  EXPECT_LT(after_W.x(), before_W.x() - 0.2);
  EXPECT_NEAR(after_W.y(), before_W.y(), 1e-6);
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  EXPECT_LT((again->start_W - after_W).norm(), 1e-9);
}

TEST(Navigator, goes_back_by_the_way_it_came_where_no_step_aside_lets_a_plan_begin) {
  expect_it_goes_back({});
}

// Such a vehicle turned to and fro between its view and the way back, and never planned again.
TEST(Navigator, goes_back_although_it_is_to_look_elsewhere_at_its_goal) {
  expect_it_goes_back(2.0);
}

TEST(Navigator, counts_a_plan_that_led_nowhere_as_failed_until_it_moves) {
  Trip trip;
  const auto fly_for = [&](int ticks) {
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.navigator.path_planned(trip.now, {query->id, straight(query->start_W, {40, 0, 1.5}), ""});
    trip.tick(ticks);
  };
  trip.map.fill({Vec3{-2, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.set_goal(Vec3{40, 0, 1.5});
  fly_for(400);  // 8 s
  fly_for(400);
  EXPECT_EQ(trip.navigator.state().planner_failures, 1);
  EXPECT_EQ(trip.declared_W.size(), 1U);
  trip.map.fill({Vec3{-2, -3, 0}, Vec3{60, 3, 3}}, CellState::free);
  fly_for(100);
  EXPECT_EQ(trip.navigator.state().planner_failures, 0);
}

TEST(Navigator, goes_back_from_the_unknown_that_it_stands_too_near_to_see_and_then_plans_anew) {
  Trip trip;
  trip.map.fill({Vec3{5, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.set_goal(Vec3{40, 0, 1.5});
  double nearest_m = 0.0;
  int plans = 0;
  for (int i = 0; i < 1500; ++i) {
    if (const auto query = trip.navigator.next_query(trip.now)) {
      ++plans;
      trip.navigator.path_planned(trip.now,
                                  {query->id, straight(query->start_W, {40, 0, 1.5}), ""});
    }
    trip.tick(1);
    const double x_m = trip.navigator.follower().position_W().x();
    nearest_m = std::max(nearest_m, x_m);
    if (x_m < nearest_m - 0.2) {  // From here the camera sees more.
      trip.map.fill({Vec3{5, -3, 0}, Vec3{60, 3, 3}}, CellState::free);
    }
  }
  EXPECT_GT(trip.navigator.follower().position_W().x(), 6.0);
  EXPECT_EQ(plans, 2) << "one from the start and one from farther back";
}

TEST(Navigator, ignores_a_check_of_a_path_that_is_no_longer_flown) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  const auto query = trip.navigator.next_query(trip.now);
  trip.answer(*query);
  PathClearance old;
  old.revision = {99, trip.now, 0.15, std::make_shared<const kit::GridMap>(trip.map)};
  old.published = trip.now;
  old.path_number = trip.navigator.state().path_number - 1;
  old.blocked_at_m = 2.0;
  trip.navigator.path_checked(trip.now, old);
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
}

TEST(Navigator, gives_up_with_no_plan_after_the_time_limit) {
  Scenario scenario = kit::MissionRig::one_core();
  scenario.mission.plan_time_limit_s = 5.0;
  Trip trip{scenario};
  trip.set_goal(Vec3{40, 0, 1.5});
  for (int i = 0; i < 400 && !trip.gave_up; ++i) {
    if (const auto query = trip.navigator.next_query(trip.now)) {
      trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
    }
    trip.tick(1);
  }
  EXPECT_TRUE(trip.gave_up);
  EXPECT_GT(trip.navigator.state().planner_failures, 3);
}

TEST(Navigator, bounds_latency_by_the_worst_of_late_and_tells_what_exceeds_it) {
  Trip trip;
  trip.tick(30);
  const int before = trip.late_maps;
  EXPECT_LE(before, 1) << "the first map, since this computer's price is none";
  trip.publish_map(900ms);
  (void)trip.navigator.tick(trip.now, 20ms, trip.where);
  const NavigatorNews news = trip.navigator.news();
  ASSERT_TRUE(news.map_use);
  EXPECT_GT(news.map_use->budget_use, 1.0);
  EXPECT_NEAR(news.map_use->sensor_to_command_s, 0.9, 1e-9);
  EXPECT_GE(trip.navigator.follower().latency_bound(), 990ms);
}

TEST(Navigator, tells_which_command_it_has_heard_and_forgets_failures_at_a_new_goal) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  EXPECT_EQ(trip.navigator.state().obeyed, trip.commands);
  const auto query = trip.navigator.next_query(trip.now);
  trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
  EXPECT_EQ(trip.navigator.state().planner_failures, 1);
  trip.set_goal(Vec3{30, 0, 1.5});
  EXPECT_EQ(trip.navigator.state().planner_failures, 0);
  EXPECT_EQ(trip.navigator.state().goal_W, (Vec3{30, 0, 1.5}));
}

TEST(Navigator, asks_for_no_plan_before_it_has_a_map) {
  const kit::GridMap map = kit::corridor(60.0);
  const kit::MissionRig rig{map};
  Navigator navigator{rig.brief, rig.kernels.path_tracker};
  navigator.set_knobs(MissionTime{}, rig.knobs);
  navigator.obey(MissionTime{}, {1, GoTo{Vec3{40, 0, 1.5}, {}}});
  EXPECT_FALSE(navigator.next_query(MissionTime{1s}).has_value());
}

}  // namespace
}  // namespace flyball
