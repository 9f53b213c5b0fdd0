// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigator.h"

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
  trip.navigator.set_goal(trip.now, Vec3{20, 0, 1.5});
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());  // One at a time.
  trip.navigator.path_planned(trip.now, {query->id, straight(query->start_W, query->goal_W), ""});
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
}

TEST(Navigator, reaches_a_far_goal_through_places_on_the_way) {
  const GridMap map = kit::corridor(60.0);
  Scenario scenario = kit::MissionRig::one_core();
  scenario.planner.horizon_m = 20.0;
  MissionBrief brief;
  brief.bounds_W = {Vec3{-2, -3, 0}, Vec3{60, 3, 3}};
  kit::MissionRig rig{map, scenario, brief};
  Navigator navigator{*rig.context};
  navigator.hover_at(Vec3{0, 0, 1.5}, 0.0);
  MissionTime now{1s};
  navigator.set_goal(now, Vec3{50, 0, 1.5});
  PoseEstimate where;
  double least_m_s = 10.0;
  int plans = 0;
  for (int i = 0; i < 3000 && !navigator.has_arrived(); ++i) {
    if (const auto query = navigator.next_query(now)) {
      EXPECT_LE((query->goal_W - query->start_W).norm(), 20.0 + 1e-9);
      ++plans;
      navigator.path_planned(now, {query->id, straight(query->start_W, query->goal_W), ""});
    }
    now += 20ms;
    where.X_WB.translation() = navigator.follower().position_W();
    if (i % 5 == 0) {
      navigator.map_published(now, {static_cast<std::uint64_t>(i), now - 100ms, now, 0.15});
    }
    (void)navigator.tick(now, 20ms, where);
    const double x_m = navigator.follower().position_W().x();
    if (x_m > 10.0 && x_m < 40.0) {
      least_m_s = std::min(least_m_s, navigator.follower().speed_m_s());
    }
  }
  EXPECT_TRUE(navigator.has_arrived());
  EXPECT_GE(plans, 3);
  EXPECT_LE(plans, 8);
  EXPECT_GT(least_m_s, 1.0) << "it does not stop between two legs";
}

TEST(Navigator,
     plans_from_a_point_ahead_when_its_path_is_blocked_and_stops_there_if_no_answer_comes) {
  Trip trip;
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  const auto first = trip.navigator.next_query(trip.now);
  trip.navigator.path_planned(trip.now, {first->id, straight(first->start_W, first->goal_W), ""});
  trip.tick(100);
  const double x = trip.navigator.follower().position_W().x();
  trip.navigator.path_checked(trip.now, {30.0, 25.0}, trip.navigator.path_number());
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
  trip.navigator.path_planned(trip.now, {late->id, straight(late->start_W, late->goal_W), ""});
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  EXPECT_NEAR(again->start_W.x(), trip.navigator.follower().position_W().x(), 0.02);
}

// It creeps on with each cell that becomes known, and was beyond every splice where it stood.
TEST(Navigator, adopts_the_first_plan_where_it_stands_before_unknown_space) {
  Trip trip;
  trip.map.fill({Vec3{5, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  const auto first = trip.navigator.next_query(trip.now);
  trip.navigator.path_planned(trip.now, {first->id, straight(first->start_W, first->goal_W), ""});
  trip.tick(500);
  ASSERT_LT(trip.navigator.follower().speed_m_s(), 0.05);
  const double stands_at_m = trip.navigator.follower().position_W().x();
  trip.navigator.path_checked(trip.now, {30.0, 5.0}, trip.navigator.path_number());
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.map.fill({Vec3{5, -3, 0}, Vec3{5.15, 3, 3}}, CellState::free);
  trip.tick(100);
  EXPECT_NEAR(trip.navigator.follower().position_W().x(), stands_at_m, 0.01) << "it waits";
  const auto number = trip.navigator.path_number();
  trip.navigator.path_planned(trip.now, {query->id, straight(query->start_W, query->goal_W), ""});
  EXPECT_EQ(trip.navigator.path_number(), number + 1);
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "it was adopted";
}

/// Its path is blocked; the new one is longer by `detour_m`.
void replan(Trip& trip, double detour_m) {
  trip.navigator.path_checked(trip.now, {15.0, 12.0}, trip.navigator.path_number());
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.navigator.path_planned(trip.now,
                              {query->id, detour(query->start_W, query->goal_W, detour_m), ""});
}

TEST(Navigator, flies_a_longer_way_at_once) {
  Trip trip;
  trip.navigator.set_goal(trip.now, Vec3{20, 0, 1.5});
  replan(trip, 0.0);
  trip.tick(50);
  const auto number = trip.navigator.path_number();
  replan(trip, 18.0);
  EXPECT_EQ(trip.navigator.path_number(), number + 1);
}

TEST(Navigator, flies_on_through_what_is_free_while_a_plan_around_something_far_ahead_is_made) {
  Trip trip;
  ASSERT_TRUE(trip.rig.context->knobs.set("mission.max_speed_m_s", 4.0));
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  const auto first = trip.navigator.next_query(trip.now);
  trip.navigator.path_planned(trip.now, {first->id, straight(first->start_W, first->goal_W), ""});
  trip.tick(100);
  const double cruise_m_s = trip.navigator.follower().speed_m_s();
  const double x_m = trip.navigator.follower().position_W().x();
  trip.navigator.path_checked(trip.now, {30.0, x_m + 12.0}, trip.navigator.path_number());
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.tick(50);  // A second, in which it would have come to rest.
  EXPECT_GT(trip.navigator.follower().speed_m_s(), 0.9 * cruise_m_s);
  trip.tick(1000);
  EXPECT_LT(trip.navigator.follower().speed_m_s(), 0.02);
  EXPECT_LE(trip.navigator.follower().position_W().x(), x_m + 12.0 - 3.0) << "room to turn";
  EXPECT_GT(trip.navigator.follower().position_W().x(), x_m + 12.0 - 4.0);
}

TEST(Navigator, lets_the_next_path_bend_before_its_stop_when_it_was_too_fast_for_the_last) {
  Trip trip;
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  replan(trip, 0.0);
  trip.tick(100);
  trip.navigator.path_checked(trip.now, {15.0, 12.0}, trip.navigator.path_number());
  const auto first = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(first->lead_in_W.has_value());
  const Vec3 aside_W = first->start_W + Vec3{0, 3, 0};
  trip.navigator.path_planned(trip.now,
                              {first->id, along({first->start_W, aside_W, first->goal_W}), ""});
  const auto second = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(second.has_value());
  ASSERT_TRUE(second->lead_in_W.has_value());
  EXPECT_GT(second->start_W.x(), second->lead_in_W->x() + 0.3);
  trip.navigator.path_planned(
      trip.now, {second->id, along({*second->lead_in_W, aside_W, second->goal_W}), ""});
  const auto third = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(third.has_value());
  EXPECT_FALSE(third->lead_in_W.has_value());  // From rest.
  EXPECT_NEAR(third->start_W.x(), second->start_W.x(), 0.1);
}

TEST(Navigator, calls_the_place_clear_where_it_rests_when_a_plan_cannot_begin_there) {
  Trip trip;
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  for (const char* why : {"no path", "start blocked"}) {
    EXPECT_TRUE(trip.rig.mapper->declared_W.empty());
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.tick(60);
    trip.navigator.path_planned(trip.now, {query->id, {}, why});
    trip.tick(60);
  }
  ASSERT_EQ(trip.rig.mapper->declared_W.size(), 1U);
  EXPECT_LT((trip.rig.mapper->declared_W[0] - Vec3{0, 0, 1.5}).norm(), 1e-9);
}

TEST(Navigator, steps_out_of_what_reaches_into_its_tube_when_a_plan_cannot_begin_there) {
  Trip trip;
  const double radius_m = trip.rig.context->narrow_body().radius_m;
  // The cell's border is a centimetre inside of the tube.
  const double inside_m = 0.01;
  trip.navigator.hover_at(Vec3{0, 3.0 - 0.15 - radius_m + inside_m, 1.5}, 0.0);
  trip.map.fill({Vec3{-2, 2.85, 0}, Vec3{60, 3, 3}}, CellState::occupied);
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  trip.tick(60);
  const Cylinder body = trip.rig.context->narrow_body();
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

TEST(Navigator, counts_a_plan_that_led_nowhere_as_failed_until_it_moves) {
  Trip trip;
  const auto fly_for = [&](int ticks) {
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.navigator.path_planned(trip.now, {query->id, straight(query->start_W, {40, 0, 1.5}), ""});
    trip.tick(ticks);
  };
  trip.map.fill({Vec3{-2, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  fly_for(400);  // 8 s
  fly_for(400);
  EXPECT_EQ(trip.rig.context->counters.planner_failures_in_row, 1);
  EXPECT_EQ(trip.rig.mapper->declared_W.size(), 1U);
  trip.map.fill({Vec3{-2, -3, 0}, Vec3{60, 3, 3}}, CellState::free);
  fly_for(100);
  EXPECT_EQ(trip.rig.context->counters.planner_failures_in_row, 0);
}

TEST(Navigator, goes_back_from_the_unknown_that_it_stands_too_near_to_see_and_then_plans_anew) {
  Trip trip;
  trip.map.fill({Vec3{5, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
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
  EXPECT_LE(plans, 3) << "one from the start, one from where it stood, one from farther back";
}

TEST(Navigator, ignores_a_check_of_a_path_that_is_no_longer_flown) {
  Trip trip;
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  const auto query = trip.navigator.next_query(trip.now);
  trip.navigator.path_planned(trip.now, {query->id, straight(query->start_W, query->goal_W), ""});
  trip.navigator.path_checked(trip.now, {3.0, 2.0}, trip.navigator.path_number() - 1);
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
}

TEST(Navigator, gives_up_with_no_plan_after_the_time_limit) {
  Scenario scenario = kit::MissionRig::one_core();
  scenario.mission.plan_time_limit_s = 5.0;
  Trip trip{scenario};
  trip.navigator.set_goal(trip.now, Vec3{40, 0, 1.5});
  for (int i = 0; i < 400 && !trip.rig.context->is_over(); ++i) {
    if (const auto query = trip.navigator.next_query(trip.now)) {
      trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
    }
    trip.tick(1);
  }
  EXPECT_EQ(trip.rig.context->failure(), MissionFailure::no_plan);
  EXPECT_GT(trip.rig.context->counters.planner_failures_in_row, 3);
}

TEST(Navigator, bounds_latency_by_the_worst_of_late_and_counts_what_exceeds_it) {
  Trip trip;
  trip.tick(30);
  const std::uint64_t before = trip.rig.context->counters.bound_overruns;
  EXPECT_LE(before, 1U) << "the first map, since this computer's price is none";
  trip.navigator.map_published(trip.now, {99, trip.now - 900ms, trip.now, 0.15});
  EXPECT_EQ(trip.rig.context->counters.bound_overruns, before + 1);
  EXPECT_GE(trip.navigator.follower().latency_bound(), 990ms);
}

}  // namespace
}  // namespace flyball
