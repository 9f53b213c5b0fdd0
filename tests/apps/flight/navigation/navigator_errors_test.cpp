// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigator.h"

#include "navigator_trip.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using kit::Trip;

// Two corrections beside each other make a vehicle sway.
TEST(Navigator, leaves_errors_to_a_flight_controller) {
  for (const bool leaves : {false, true}) {
    Trip trip;
    trip.rig.brief->leaves_errors_to_controller = leaves;
    trip.set_goal(Vec3{20, 0, 1.5});
    const auto query = trip.navigator.next_query(trip.now);
    ASSERT_TRUE(query.has_value());
    trip.answer(*query);
    trip.tick(100);
    trip.where.X_WB.translation().y() += 0.1;
    const Setpoint setpoint = trip.navigator.tick(trip.now, 20ms, trip.where);
    EXPECT_DOUBLE_EQ(setpoint.p_WB.y(), 0.0);
    EXPECT_EQ(setpoint.v_WB.y() == 0.0, leaves) << setpoint.v_WB.y();
  }
}

TEST(Navigator, that_was_told_to_stand_has_not_stalled) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  trip.answer(*trip.navigator.next_query(trip.now));
  trip.tick(100);
  for (int i = 0; i < 500; ++i) {  // No pose for ten seconds.
    trip.now += 20ms;
    (void)trip.navigator.tick(trip.now, 20ms, trip.where);
  }
  EXPECT_LT(trip.navigator.follower().speed_m_s(), 1e-9);
  EXPECT_FALSE(trip.navigator.next_query(trip.now));
  EXPECT_TRUE(trip.navigator.follower().has_path());
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
}

// A localizer that has lost its place may have moved the vehicle back, while a view was had.
TEST(Navigator, stays_where_a_search_for_its_place_has_ended) {
  for (const bool has_goal : {false, true}) {
    Trip trip;
    if (has_goal) {
      trip.set_goal(Vec3{20, 0, 1.5});
    }
    Setpoint search;
    search.p_WB = Vec3{0, 3, 1.5};
    (void)trip.navigator.tick(trip.now, 20ms, trip.where, search);
    trip.where.X_WB.translation() = search.p_WB;
    trip.where.stamp = trip.now;
    const Setpoint after = trip.navigator.tick(trip.now, 20ms, trip.where);
    EXPECT_NEAR((after.p_WB - search.p_WB).norm(), 0.0, 1e-9) << has_goal;
    EXPECT_EQ(trip.navigator.next_query(trip.now).has_value(), has_goal);
  }
}

TEST(Navigator, flies_its_path_on_after_a_search_for_its_place_where_nothing_is_mapped) {
  Trip trip;
  trip.rig.brief->maps_obstacles = false;
  trip.set_goal(Vec3{20, 0, 1.5});
  trip.answer(*trip.navigator.next_query(trip.now));
  trip.tick(100);
  Setpoint search;
  search.p_WB = trip.where.X_WB.translation() - Vec3{2, 0, 0};
  (void)trip.navigator.tick(trip.now, 20ms, trip.where, search);
  trip.tick(1);
  EXPECT_FALSE(trip.navigator.next_query(trip.now));
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
}

// It stands there, and may have been led back along the path.
TEST(Navigator, picks_up_its_path_from_rest_where_a_search_has_ended) {
  Trip trip;
  trip.rig.brief->maps_obstacles = false;
  trip.set_goal(Vec3{40, 0, 1.5});
  trip.answer(*trip.navigator.next_query(trip.now));
  trip.tick(150);
  ASSERT_GT(trip.navigator.state().speed_m_s, 3.0);
  Setpoint search;
  search.p_WB = trip.where.X_WB.translation() - Vec3{3, 0, 0};
  for (int i = 0; i < 500; ++i) {
    trip.now += 20ms;
    trip.where.X_WB.translation() = search.p_WB;
    trip.where.stamp = trip.now;
    (void)trip.navigator.tick(trip.now, 20ms, trip.where, search);
    EXPECT_EQ(trip.navigator.state().speed_m_s, 0.0);
  }
  const Setpoint after = trip.navigator.tick(trip.now, 20ms, trip.where);
  EXPECT_NEAR((after.p_WB - search.p_WB).norm(), 0.0, 0.1);
  EXPECT_LT(after.v_WB.norm(), 0.1);
}

TEST(Navigator, that_was_told_to_hover_does_not_give_up) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  trip.answer(*trip.navigator.next_query(trip.now));
  trip.tick(100);
  KnobsInForce hovers = *trip.rig.knobs;
  hovers.restraint.must_hover = true;
  const auto before = std::exchange(trip.rig.knobs, std::make_shared<const KnobsInForce>(hovers));
  for (int i = 0; i < 200; ++i) {
    trip.tick(50);
    ASSERT_FALSE(trip.navigator.news().gives_up) << "after " << i << " s";
    ASSERT_TRUE(trip.navigator.state().must_hover);
  }
  trip.rig.knobs = before;
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
}

// A long search on a slow computer, or one on the way from an edge computer.
TEST(Navigator, takes_a_path_that_it_has_nearly_given_up) {
  Trip trip;
  trip.set_goal(Vec3{20, 0, 1.5});
  const auto slow = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(slow);
  trip.tick(1600);  // 32 s.
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again);
  EXPECT_NE(again->id, slow->id);
  trip.answer(*slow);
  EXPECT_TRUE(trip.navigator.follower().has_path());
  trip.tick(2000);
  EXPECT_TRUE(trip.navigator.has_arrived());
}

TEST(Navigator, takes_no_path_that_was_asked_for_before_the_one_it_flies) {
  Trip trip;
  trip.set_goal(Vec3{40, 0, 1.5});
  trip.answer(*trip.navigator.next_query(trip.now));
  trip.tick(100);
  trip.block(20.0);
  const auto slow = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(slow);
  for (int i = 0; i < 1600; ++i) {  // 32 s.
    trip.tick(1);
  }
  const auto again = trip.navigator.next_query(trip.now);
  ASSERT_TRUE(again);
  trip.answer(*again);
  trip.tick(100);
  const auto number = trip.navigator.state().path_number;
  trip.answer(*slow);
  EXPECT_EQ(trip.navigator.state().path_number, number);
}

}  // namespace
}  // namespace flyball
