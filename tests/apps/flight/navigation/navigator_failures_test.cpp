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

}  // namespace
}  // namespace flyball
