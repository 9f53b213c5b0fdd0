// SPDX-License-Identifier: BSD-3-Clause
// What becomes of a path that was found but cannot be joined, or that is a way around.
#include "flyball/flight/navigation/navigator.h"

#include "navigator_trip.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::detour;
using kit::straight;
using kit::Trip;

// Seconds of search are not lost because the vehicle has flown on meanwhile.
TEST(NavigatorJoins, joins_a_path_that_came_too_late_from_a_place_ahead_without_a_search) {
  Trip trip;
  const auto late = trip.fly_until_blocked();
  ASSERT_FALSE(late->known.has_value());
  trip.tick(40);
  PlannedPath planned{late->id, straight(late->start_W, late->goal_W), ""};
  planned.path = {{late->start_W, Vec3{30, 0.1, 1.5}, late->goal_W}, {0.4, 0.2}};
  trip.navigator.path_planned(trip.now, planned);
  const double speed_m_s = trip.navigator.follower().speed_m_s();
  ASSERT_GT(speed_m_s, 1.0) << "it has not stopped yet";
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  ASSERT_TRUE(again->known.has_value());
  EXPECT_EQ(again->known->waypoints_W, planned.path.waypoints_W);
  EXPECT_EQ(again->known->body.radius_m, 0.4);
  EXPECT_GT(again->start_W.x(), trip.navigator.follower().position_W().x());
  trip.navigator.path_planned(trip.now,
                              {again->id, straight(again->start_W, Vec3{40, 0, 1.5}), ""});
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "it has been taken";
  trip.tick(50);
  EXPECT_GE(trip.navigator.follower().speed_m_s(), speed_m_s);
}

// Else a search that takes longer than the vehicle takes to stop is made again and again.
TEST(NavigatorJoins, joins_a_detour_that_costs_no_more_than_the_search_for_it) {
  for (const int ticks : {300, 1500}) {  // 6 and 30 s.
    Trip trip;
    const auto late = trip.fly_until_blocked();
    trip.tick(ticks);
    PlannedPath planned{late->id, straight(late->start_W, late->goal_W), ""};
    const Vec3 aside_W = 0.5 * (late->start_W + late->goal_W) + Vec3{0, 60, 0};
    planned.path = {{late->start_W, aside_W, late->goal_W}, {0.4, 0.2}};
    const double cost_s =
        detour_m(planned.path.waypoints_W) /
        trip.rig.situation().speed_limit_m_s(trip.navigator.follower().position_W());
    ASSERT_GT(cost_s, 6.0);
    ASSERT_LT(cost_s, 30.0);
    trip.navigator.path_planned(trip.now, planned);
    const auto again = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->known.has_value(), ticks == 1500);
  }
}

/// In larger cells than the corridor's own, the first plan has been asked for.
struct TripWithLargeCells : Trip {
  TripWithLargeCells() {
    other_map = std::make_shared<const kit::GridMap>(kit::corridor(60.0, 0.3));
    publish_map(std::chrono::milliseconds{100});
    set_goal(Vec3{20, 0, 1.5});
    query = navigator.next_query(now).value();
  }
  /// Its trajectory leads past the goal and back, and so do its waypoints.
  void answer_with_detour(const PlanQuery& to, double more_m) {
    PlannedPath planned{to.id, detour(to.start_W, to.goal_W, more_m), ""};
    const Vec3 past_W = to.goal_W + 0.5 * more_m * (to.goal_W - to.start_W).normalized();
    planned.path = {{to.start_W, past_W, to.goal_W}, {0.4, 0.2}};
    navigator.path_planned(now, planned);
  }
  std::optional<PlanQuery> query_in_small_cells() {
    other_map = nullptr;
    tick(10);
    return navigator.next_query(now);
  }
  PlanQuery query{};
};

/// The plan was a way around, which it holds back because smaller cells have been asked for.
struct TripWithHeldDetour : TripWithLargeCells {
  TripWithHeldDetour() {
    turn("map.resolution_m", 0.15);
    answer_with_detour(query, 400.0);
  }
};

// In larger cells the door was closed.
TEST(NavigatorJoins, looks_once_for_a_shorter_path_than_a_detour_when_the_map_is_finer) {
  for (const double more_m : {1.0, 10.0}) {
    TripWithLargeCells trip;
    trip.answer_with_detour(trip.query, more_m);
    trip.tick(50);
    EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "the map is as it was";
    const auto again = trip.query_in_small_cells();
    ASSERT_EQ(again.has_value(), more_m > 5.0);
    if (again) {
      trip.answer_with_detour(*again, more_m);
      trip.tick(50);
      EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "it has looked";
    }
  }
}

TEST(NavigatorJoins, does_not_fly_a_long_detour_before_it_has_seen_the_finer_map_that_is_to_come) {
  for (const double more_m : {40.0, 400.0}) {
    TripWithLargeCells trip;
    trip.turn("map.resolution_m", 0.15);
    trip.answer_with_detour(trip.query, more_m);
    EXPECT_EQ(trip.navigator.state().has_path(), more_m < 100.0);
    if (trip.navigator.state().has_path()) {
      continue;
    }
    trip.tick(10);
    EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "the map is as it was";
    const auto again = trip.query_in_small_cells();
    ASSERT_TRUE(again.has_value());
    EXPECT_FALSE(again->known.has_value()) << "a search is made";
    trip.answer_with_detour(*again, more_m);
    EXPECT_TRUE(trip.navigator.state().has_path()) << "there is no door";
  }
}

TEST(NavigatorJoins, waits_three_seconds_for_the_finer_map_and_once_only) {
  TripWithHeldDetour trip;
  trip.tick(140);  // 2.8 s.
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
  trip.tick(20);
  const auto late = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(late.has_value());
  ASSERT_TRUE(late->known.has_value()) << "no such map has come, and the detour is known";
  EXPECT_NEAR(detour_m(late->known->waypoints_W), 400.0, 1e-6);
  trip.answer_with_detour(*late, 400.0);
  EXPECT_TRUE(trip.navigator.state().has_path());

  trip.set_goal(Vec3{25, 0, 1.5});
  const auto next = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(next.has_value());
  trip.answer_with_detour(*next, 400.0);
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value()) << "another goal: it waits again";
}

TEST(NavigatorJoins, flies_the_long_detour_where_the_finer_map_shows_no_path_at_all) {
  TripWithHeldDetour trip;
  const auto finer = trip.query_in_small_cells();
  ASSERT_TRUE(finer.has_value());
  EXPECT_FALSE(finer->known.has_value());
  trip.navigator.path_planned(trip.now, {finer->id, {}, "no path"});
  EXPECT_EQ(trip.navigator.state().planner_failures, 0);
  const auto around = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(around.has_value());
  ASSERT_TRUE(around->known.has_value());
  EXPECT_NEAR(detour_m(around->known->waypoints_W), 400.0, 1e-6);
  trip.navigator.path_planned(trip.now, {around->id, {}, "edge 0 hits"});
  const auto anew = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(anew.has_value());
  EXPECT_FALSE(anew->known.has_value()) << "it is not tried again";
}

TEST(NavigatorJoins, holds_a_long_detour_back_for_one_goal_only) {
  TripWithHeldDetour trip;
  trip.set_goal(Vec3{25, 0, 1.5});
  const auto other = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(other.has_value());
  EXPECT_FALSE(other->known.has_value());
  trip.answer_with_detour(*other, 40.0);
  EXPECT_TRUE(trip.navigator.state().has_path());
  const auto finer = trip.query_in_small_cells();
  ASSERT_TRUE(finer.has_value()) << "40 m are worth a look";
  EXPECT_FALSE(finer->known.has_value());
  trip.navigator.path_planned(trip.now, {finer->id, {}, "no path"});
  EXPECT_EQ(trip.navigator.state().planner_failures, 1) << "nothing is held back any more";
}

TEST(NavigatorJoins, searches_in_any_cells_that_are_smaller_than_those_of_the_long_detour) {
  TripWithHeldDetour trip;
  trip.other_map = std::make_shared<const kit::GridMap>(kit::corridor(60.0, 0.2));
  trip.tick(160);  // 3.2 s.
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  EXPECT_FALSE(again->known.has_value());
  PlannedPath moved{again->id, {}, "edge 0 hits"};
  moved.map_moved_on = true;
  trip.navigator.path_planned(trip.now, moved);
  trip.tick(170);
  const auto on_newer = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(on_newer.has_value());
  EXPECT_FALSE(on_newer->known.has_value()) << "only the map was too old";
}

// The policy is to see that no search has led to a path that is flown.
TEST(NavigatorJoins, counts_failed_searches_on_while_it_waits_for_the_finer_map) {
  TripWithLargeCells trip;
  trip.turn("map.resolution_m", 0.15);
  trip.navigator.path_planned(trip.now, {trip.query.id, {}, "no path"});
  trip.tick(200);
  trip.answer_with_detour(trip.navigator.next_query(trip.now).value(), 400.0);
  EXPECT_FALSE(trip.navigator.state().has_path());
  EXPECT_EQ(trip.navigator.state().planner_failures, 1);
  trip.tick(160);
  trip.answer_with_detour(trip.navigator.next_query(trip.now).value(), 400.0);
  EXPECT_TRUE(trip.navigator.state().has_path());
  EXPECT_EQ(trip.navigator.state().planner_failures, 0);
}

TEST(NavigatorJoins, flies_a_long_detour_on_where_it_has_stopped_and_found_no_shorter_path) {
  TripWithLargeCells trip;
  trip.turn("map.resolution_m", 0.3);
  trip.answer_with_detour(trip.query, 400.0);
  trip.tick(50);
  const auto again = trip.query_in_small_cells();
  ASSERT_TRUE(again.has_value());
  trip.tick(150);
  ASSERT_LT(trip.navigator.follower().speed_m_s(), 0.1);
  trip.navigator.path_planned(trip.now, {again->id, {}, "no path"});
  EXPECT_EQ(trip.navigator.state().planner_failures, 0) << "a path is known";
  trip.tick(100);
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
  EXPECT_GT(trip.navigator.follower().speed_m_s(), 1.0);
  EXPECT_LT(std::abs(trip.navigator.follower().yaw_rad()), 0.1) << "it looks ahead again";
}

TEST(NavigatorJoins, looks_beside_the_goal_while_it_waits_for_the_finer_map) {
  for (const double more_m : {40.0, 400.0}) {
    TripWithLargeCells trip;
    trip.turn("map.resolution_m", 0.15);
    trip.answer_with_detour(trip.query, more_m);
    trip.tick(50);
    EXPECT_EQ(std::abs(trip.navigator.follower().yaw_rad()) > 0.5, more_m > 100.0);
  }
}

// While it flies on along the detour, it passes the place where the way through the door begins.
TEST(NavigatorJoins, stops_on_a_long_detour_while_it_looks_for_a_shorter_path) {
  for (const double more_m : {10.0, 400.0}) {
    TripWithLargeCells trip;
    trip.turn("map.resolution_m", 0.3);  // It waits for none yet.
    trip.answer_with_detour(trip.query, more_m);
    trip.tick(50);
    const auto again = trip.query_in_small_cells();
    ASSERT_TRUE(again.has_value());
    const PathFollower& follower = trip.navigator.follower();
    ASSERT_GT(follower.speed_m_s(), 1.0);
    const Vec3 stop_W = follower.path().at(follower.planned_stop_m()).p_W;
    EXPECT_EQ((again->start_W - stop_W).norm() < 1e-6, more_m > 100.0) << more_m;
    trip.tick(150);
    EXPECT_EQ(std::abs(trip.navigator.follower().yaw_rad()) > 0.1, more_m > 100.0)
        << "where it stands, it looks for the way to the goal";
  }
}

TEST(NavigatorJoins, plans_anew_where_a_known_path_does_not_join_and_counts_no_failure) {
  Trip trip;
  const auto late = trip.fly_until_blocked();
  trip.tick(40);
  PlannedPath planned{late->id, straight(late->start_W, late->goal_W), ""};
  planned.path = {{late->start_W, late->goal_W}, {0.4, 0.2}};
  trip.navigator.path_planned(trip.now, planned);
  const auto joined = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(joined->known.has_value());
  trip.navigator.path_planned(trip.now, {joined->id, {}, "edge 0 hits"});
  EXPECT_EQ(trip.navigator.state().planner_failures, 0);
  const auto anew = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(anew.has_value());
  EXPECT_FALSE(anew->known.has_value());
}

}  // namespace
}  // namespace flyball
