// SPDX-License-Identifier: BSD-3-Clause
// When a plan that failed is made again.
#include "flyball/flight/navigation/navigator.h"

#include "navigator_trip.h"
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using kit::Trip;

TEST(NavigatorFailures, plans_anew_after_the_governors_next_look_when_only_the_map_has_moved_on) {
  for (const bool moved_on : {false, true}) {
    Trip trip;
    trip.set_goal(Vec3{20, 0, 1.5});
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.navigator.path_planned(trip.now, {query->id, {}, "hits an occupied cell", moved_on});
    EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
    trip.now += from_seconds(trip.rig.scenario.governor.period_s);
    EXPECT_EQ(trip.navigator.next_query(trip.now).has_value(), moved_on);
    EXPECT_EQ(trip.navigator.state().planner_failures, moved_on ? 0U : 1U) << "a path was found";
  }
}

TEST(NavigatorFailures, asks_again_for_a_plan_whose_answer_was_lost) {
  Trip trip;
  trip.set_goal(Vec3{20, 0, 1.5});
  const auto lost = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(lost.has_value());
  trip.now += 30s;
  EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
  trip.now += 1s;
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again.has_value());
  EXPECT_NE(again->id, lost->id);
}

TEST(NavigatorFailures, waits_for_smaller_cells_after_a_plan_that_failed_in_large_ones) {
  for (const bool comes : {false, true}) {
    Trip trip;
    trip.set_goal(Vec3{20, 0, 1.5});
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
    const double cell_m = trip.map.resolution_m();
    trip.turn("map.resolution_m", 0.5 * cell_m);
    trip.now += 2s;
    EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
    if (comes) {  // As the map does with its next frame.
      trip.turn("map.resolution_m", cell_m);
    } else {
      trip.now += 2s;
    }
    EXPECT_TRUE(trip.navigator.next_query(trip.now).has_value());
  }
}

/// It hovers at the origin and looks east.
TEST(NavigatorFailures, looks_towards_its_goal_and_to_both_sides_after_a_plan_that_failed) {
  Trip trip;
  trip.set_goal(Vec3{0, 20, 1.5});
  trip.tick(100);
  EXPECT_EQ(trip.navigator.state().yaw_rad, 0.0) << "no plan has failed";
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
  double least_rad = 3.0;
  double most_rad = 0.0;
  for (int i = 0; i < 400; ++i) {
    trip.tick(1);
    most_rad = std::max(most_rad, trip.navigator.state().yaw_rad);
    if (most_rad > 2.0) {
      least_rad = std::min(least_rad, trip.navigator.state().yaw_rad);
    }
  }
  constexpr double north_rad = 1.5707963267948966;
  EXPECT_GT(most_rad, north_rad + 0.7);
  EXPECT_LT(least_rad, north_rad - 0.7);
}

/// So many searches for another path fail. @return What is asked for then.
std::optional<PlanQuery> fail(Trip& trip, std::optional<PlanQuery> query, int searches) {
  for (int i = 0; i < searches; ++i) {
    if (!query) {
      ADD_FAILURE() << "asks for no plan after " << i;
      break;
    }
    trip.navigator.path_planned(trip.now, {query->id, {}, "no path"});
    trip.tick(600);
    query = trip.navigator.next_query(trip.now);
  }
  return query;
}

/// Flies east until its path is blocked and stands there, while searches for another path fail.
///
/// @return How far it has gone back after so many of them [m].
double goes_back_m(Trip& trip, int searches) {
  const auto query = trip.fly_until_blocked();
  trip.tick(1000);
  const Vec3 before_W = trip.navigator.follower().position_W();
  (void)fail(trip, query, searches);
  return (trip.navigator.follower().position_W() - before_W).norm();
}

TEST(NavigatorFailures, looks_for_a_path_from_elsewhere_when_three_searches_have_found_none) {
  for (const auto& [searches, away_m] : {std::pair{2, 0.0}, std::pair{3, 4.0}, std::pair{4, 8.0}}) {
    Trip trip;
    EXPECT_NEAR(goes_back_m(trip, searches), away_m, 0.11) << searches;
    ASSERT_EQ(trip.doubted.empty(), searches < 3) << "there obstacles are looked at anew";
    if (!trip.doubted.empty()) {
      const Vec3 stands_W = trip.navigator.follower().position_W();
      EXPECT_NEAR((trip.doubted.front().centre_W - stands_W).norm(), away_m, 0.11);
      EXPECT_GT(trip.doubted.front().radius_m, 8.0);
    }
  }
}

TEST(NavigatorFailures, doubts_obstacles_from_one_place_three_times_on_the_way_to_a_goal) {
  Trip trip;
  auto query = trip.fly_until_blocked();
  for (std::size_t visit = 1; visit <= 5; ++visit) {
    trip.tick(1000);
    query = fail(trip, query, 3);
    EXPECT_EQ(trip.doubted.size(), std::min(visit, std::size_t{3}));
    ASSERT_TRUE(query);
    trip.answer(*query);  // Where nothing is known any more, a path is found; the wall is real.
    trip.tick(50);
    trip.block(7.0);
    query = trip.navigator.next_query(trip.now);
  }
  (void)goes_back_m(trip, 3);
  EXPECT_EQ(trip.doubted.size(), 4U) << "the way to another goal";
}

TEST(NavigatorFailures, gives_up_where_obstacles_were_doubted_and_paths_lead_no_nearer) {
  for (const int searches : {0, 3}) {
    Trip trip;
    auto query = trip.fly_until_blocked();
    trip.tick(1000);
    query = fail(trip, query, searches);
    EXPECT_FALSE(trip.gave_up);
    const MissionTime before = trip.now;
    while (to_seconds(trip.now - before) < 280.0) {  // Three times the patience at a standstill.
      ASSERT_TRUE(query);
      trip.answer(*query);
      trip.tick(10);
      trip.block(0.5);
      query = trip.navigator.next_query(trip.now);
      trip.tick(1000);
    }
    EXPECT_EQ(trip.gave_up, searches > 0) << searches;
  }
}

TEST(NavigatorFailures, looks_for_a_path_from_elsewhere_where_the_mission_is_slow_too) {
  Site site;
  site.zones = {{{Vec3{3, -3, 0}, Vec3{60, 3, 3}}, slow_m_s}};
  for (const auto& [searches, away_m] : {std::pair{2, 0.0}, std::pair{3, 4.0}}) {
    Trip trip{kit::MissionRig::one_core(), site};
    EXPECT_NEAR(goes_back_m(trip, searches), away_m, 0.11) << searches;
  }
}

TEST(NavigatorFailures, stays_and_keeps_its_map_where_the_mission_has_other_goals) {
  Trip trip;
  trip.is_one_of_many = true;
  EXPECT_NEAR(goes_back_m(trip, 4), 0.0, 0.01);
  EXPECT_TRUE(trip.doubted.empty());
}

void tick_until_it_stands(Trip& trip) {
  while (trip.navigator.follower().stalled(trip.now) == Duration::zero()) {
    trip.tick(1);
    ASSERT_LT(to_seconds(trip.now), 60.0);
  }
}

/// Flies along this path until the vehicle stands before what is unknown from x = 5 m on.
void fly_to_the_unknown(Trip& trip, const std::vector<Vec3>& corners_W) {
  trip.map.fill({Vec3{5, -3, 0}, Vec3{60, 3, 3}}, CellState::unknown);
  trip.set_goal(corners_W.back());
  const auto query = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(query.has_value());
  trip.navigator.path_planned(trip.now, {query->id, kit::along(corners_W), ""});
  tick_until_it_stands(trip);
}

/// @return  How long it has stood when it begins to step back [s].
double stands_before_it_steps_back_s(Trip& trip) {
  const MissionTime stands = trip.now;
  while (trip.navigator.follower().has_path() && to_seconds(trip.now - stands) < 60.0) {
    EXPECT_FALSE(trip.navigator.next_query(trip.now).has_value());
    trip.tick(1);
  }
  return to_seconds(trip.now - stands);
}

// To both sides it would see nothing more of what lies below its camera's field.
TEST(NavigatorFailures, steps_back_when_some_maps_have_not_shown_what_it_stands_too_near_to_see) {
  Trip trip;
  fly_to_the_unknown(trip, {Vec3{0, 0, 1.5}, Vec3{40, 0, 1.5}});
  const double stands_s = stands_before_it_steps_back_s(trip);
  EXPECT_GT(stands_s, 0.5);
  EXPECT_LT(stands_s, 1.0);
}

// From one place a few are enough; then it takes its time, and a plan may lead elsewhere.
TEST(NavigatorFailures, looks_to_both_sides_before_it_plans_where_it_has_stepped_back_three_times) {
  Trip trip;
  fly_to_the_unknown(trip, {Vec3{0, 0, 1.5}, Vec3{40, 0, 1.5}});
  for (int times = 0; times < 4; ++times) {
    const MissionTime stands = trip.now;
    auto query = trip.navigator.next_query(trip.now);
    while (!query && to_seconds(trip.now - stands) < 60.0) {
      trip.tick(1);
      query = trip.navigator.next_query(trip.now);
    }
    ASSERT_TRUE(query.has_value());
    EXPECT_EQ(to_seconds(trip.now - stands) > 5.9, times == 3) << times;
    trip.answer(*query);
    tick_until_it_stands(trip);
  }
}

TEST(NavigatorFailures, looks_at_what_it_stands_before_and_not_around_the_next_corner) {
  Trip trip;
  fly_to_the_unknown(trip, {Vec3{0, 0, 1.5}, Vec3{6, 0, 1.5}, Vec3{6, 2.5, 1.5}});
  (void)stands_before_it_steps_back_s(trip);
  trip.tick(50);
  EXPECT_LT(std::abs(trip.navigator.follower().yaw_rad()), 0.4);
}

/// Lets the vehicle go on, and says how far its reference goes [m].
double goes_m(Trip& trip, int ticks) {
  const Vec3 from_W = trip.navigator.follower().position_W();
  trip.tick(ticks);
  return (trip.navigator.follower().position_W() - from_W).norm();
}

TEST(NavigatorFailures, steps_back_no_farther_while_the_fallback_asks_for_a_hover) {
  Trip trip;
  fly_to_the_unknown(trip, {Vec3{0, 0, 1.5}, Vec3{40, 0, 1.5}});
  (void)stands_before_it_steps_back_s(trip);
  EXPECT_GT(goes_m(trip, 25), 0.05);
  KnobsInForce hovers = *trip.rig.knobs;
  hovers.restraint.must_hover = true;
  const auto before = std::exchange(trip.rig.knobs, std::make_shared<const KnobsInForce>(hovers));
  EXPECT_LT(goes_m(trip, 50), 0.001);
  trip.rig.knobs = before;
  EXPECT_GT(goes_m(trip, 25), 0.05);
}

TEST(NavigatorFailures, searches_no_farther_while_the_fallback_asks_for_a_hover) {
  Trip trip;
  trip.tick(5);
  Setpoint search;
  search.p_WB = Vec3{1, 0, 1.5};
  EXPECT_EQ(trip.navigator.tick(trip.now, 20ms, trip.where, search).p_WB.x(), 1.0);
  KnobsInForce hovers = *trip.rig.knobs;
  hovers.restraint.must_hover = true;
  trip.navigator.set_knobs(trip.now, std::make_shared<const KnobsInForce>(hovers));
  search.p_WB.x() = 0.5;
  EXPECT_EQ(trip.navigator.tick(trip.now, 20ms, trip.where, search).p_WB.x(), 1.0);
  trip.navigator.set_knobs(trip.now, trip.rig.knobs);
  EXPECT_EQ(trip.navigator.tick(trip.now, 20ms, trip.where, search).p_WB.x(), 0.5);
}

// The link to the autopilot is silent: its set-points go on, its navigation samples do not.
TEST(NavigatorFailures, stops_on_its_path_when_no_poses_come) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  trip.answer(*trip.navigator.next_query(trip.now));
  trip.tick(100);
  ASSERT_GT(trip.navigator.follower().speed_m_s(), 1.0);
  Setpoint last;
  for (int i = 0; i < 200; ++i) {
    trip.now += 20ms;
    trip.publish_map(100ms);
    last = trip.navigator.tick(trip.now, 20ms, trip.where);
  }
  EXPECT_LT(trip.navigator.follower().speed_m_s(), 1e-3);
  EXPECT_LT(last.v_WB.norm(), 1e-3) << "an old pose draws it nowhere";
  trip.tick(100);
  EXPECT_GT(trip.navigator.follower().speed_m_s(), 0.5) << "poses come again";
}

}  // namespace
}  // namespace flyball
