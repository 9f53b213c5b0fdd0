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

}  // namespace
}  // namespace flyball
