// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mission_checks.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Brief matrice() {
  Brief brief;
  brief.body = {0.325, 0.1};
  brief.site.bounds_W = {{-10.0, -10.0, 0.5}, {10.0, 10.0, 20.0}};
  brief.site.cruise_height_m = 1.5;
  return brief;
}

TEST(MissionChecks, a_vehicle_may_start_where_its_camera_sees_all_that_is_not_declared_clear) {
  EXPECT_TRUE(check_start(matrice()));
}

TEST(MissionChecks, a_body_wider_than_the_clear_space_cannot_leave_its_start) {
  Brief brief = matrice();
  brief.tube.at_rest_m = 0.7;
  const Status refused = check_start(brief);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("it needs 1.49 m and 2.34 m"), std::string::npos)
      << refused.error().message;
}

TEST(MissionChecks, a_flight_above_the_clear_space_cannot_leave_its_start) {
  Brief brief = matrice();
  brief.site.cruise_height_m = 2.5;
  EXPECT_TRUE(check_start(brief));  // It is held closely.
  brief.tube.at_rest_m = 0.2;
  EXPECT_FALSE(check_start(brief));
  brief.site.clear_height_m = 3.0;
  EXPECT_TRUE(check_start(brief));
}

TEST(MissionChecks, a_camera_that_sees_the_whole_height_too_far_ahead_cannot_leave_its_start) {
  Brief brief = matrice();
  brief.tube.at_rest_m = 0.5;
  const Status refused = check_start(brief);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("it needs 1.14 m and 2.14 m"), std::string::npos)
      << refused.error().message;
  brief.site.start_clear_m = 1.5;
  EXPECT_TRUE(check_start(brief));
  brief.site.start_clear_m = 1.0;
  brief.maps_obstacles = false;  // What is declared clear is all that counts.
  EXPECT_TRUE(check_start(brief));
}

// A body of .65 m takes the air up to 1.32 m; a stool of .4 m stands .3 m from its middle.
TEST(MissionChecks, a_vehicle_neither_starts_nor_lands_in_something_low) {
  SimulatedThings things;
  things.airframe.body_diameter_m = 0.65;
  things.airframe.body_height_m = 0.24;
  things.world.cruise_height_m = 1.2;
  things.world.goal_W = {10.0, 0.0, 0.0};
  EXPECT_TRUE(check_room(things, true));
  const Vec3 stool_m{0.4, 0.4, 0.4};
  const Vec3 beside{0.3, -0.2, 0.0};
  things.world.boxes = {{things.world.goal_W + beside, things.world.goal_W + beside + stool_m}};
  EXPECT_TRUE(check_room(things, false)) << "a mission that does not land there";
  const Status refused = check_room(things, true);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "goal (10.00, 0.00) m has no room for a vehicle that is 0.65 m wide, between the "
            "ground and 1.32 m above it; choose another place in [world], or a smaller "
            "vehicle.airframe");
  things.airframe.body_diameter_m = 0.58;
  EXPECT_TRUE(check_room(things, true)) << "a narrower one";
  things.world.boxes = {{beside, beside + stool_m}};
  things.airframe.body_diameter_m = 0.65;
  EXPECT_FALSE(check_room(things, false));
}

TEST(MissionChecks, no_event_happens_to_a_computer_that_is_not_modeled) {
  MissionHooks real;
  real.executor = [](const Graph&, const Platform&, EventQueue&, const OperatingPoint&) {
    return std::unique_ptr<Executor>{};
  };
  for (const char* kind : {"slowdown", "co_runner", "cooling", "bit_flip"}) {
    Scenario scenario;
    EXPECT_TRUE(check_executor(scenario, real));
    scenario.events.emplace_back().kind = kind;
    EXPECT_TRUE(check_executor(scenario, {}));
    const Status refused = check_executor(scenario, real);
    ASSERT_FALSE(refused) << kind;
    EXPECT_EQ(refused.error().message, "events.1.kind = \"" + std::string{kind} +
                                           "\" needs the modeled computer; leave "
                                           "it out, or fly without --executor realtime");
  }
}

}  // namespace
}  // namespace flyball
