// SPDX-License-Identifier: BSD-3-Clause
// When a plan that failed is made again.
#include "flyball/flight/navigation/navigator.h"

#include "navigator_trip.h"

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
  }
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

}  // namespace
}  // namespace flyball
