// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/tracking_remarks.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(TrackingRemarks, are_made_on_an_autopilot_that_flies_worse_than_is_declared) {
  Summary summary;
  Scenario scenario;
  EXPECT_TRUE(tracking_remarks(summary, scenario).empty());  // A simulated vehicle is not measured.
  summary.quality["off_path_m_p95"] = 0.58;
  summary.quality["brake_lag_s_p99"] = 0.05;
  const auto remarks = tracking_remarks(summary, scenario);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks.front(),
            "5 % of the time the autopilot was farther off its path than 0.58 m, and "
            "vehicle.tracking_error_m says 0.02 m: set it to so much, or tune the autopilot");
  scenario.vehicle.tracking_error_m = 0.6;
  EXPECT_TRUE(tracking_remarks(summary, scenario).empty());
  scenario.vehicle.brake_lag_s = 0.02;
  EXPECT_EQ(tracking_remarks(summary, scenario).size(), 1U);
}

TEST(TrackingRemarks, say_that_the_governor_held_the_vehicle) {
  Summary summary;
  summary.quality["held_percent"] = 5.0;
  EXPECT_TRUE(tracking_remarks(summary, Scenario{}).empty());
  summary.quality["held_percent"] = 88.0;
  const auto remarks = tracking_remarks(summary, Scenario{});
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks.front().find("the governor let the vehicle hover for 88 % of its way"), 0U);
}

TEST(TrackingRemarks, careful_settings_leave_what_is_more_careful) {
  Scenario scenario;
  EXPECT_EQ(
      make_careful(scenario, {}),
      (std::vector<std::string>{"mission.max_speed_m_s=5.0", "mission.max_acceleration_m_s2=3.0",
                                "vehicle.tracking_error_m=0.2", "vehicle.brake_lag_s=0.3"}));
  EXPECT_EQ(scenario.mission.max_speed_m_s, 5.0);
  EXPECT_EQ(scenario.mission.max_acceleration_m_s2, 3.0);
  EXPECT_EQ(scenario.vehicle.tracking_error_m, 0.2);
  EXPECT_EQ(scenario.vehicle.brake_lag_s, 0.3);
  scenario.mission.max_speed_m_s = 2.0;
  scenario.mission.max_acceleration_m_s2 = 1.0;
  scenario.vehicle.tracking_error_m = 0.5;
  EXPECT_TRUE(make_careful(scenario, {}).empty());
  EXPECT_EQ(scenario.mission.max_speed_m_s, 2.0);
}

TEST(TrackingRemarks, careful_settings_leave_what_was_asked_for) {
  Scenario scenario;
  EXPECT_EQ(
      make_careful(scenario, {"mission.max_speed_m_s", "vehicle.tracking_error_m"}),
      (std::vector<std::string>{"mission.max_acceleration_m_s2=3.0", "vehicle.brake_lag_s=0.3"}));
  EXPECT_EQ(scenario.mission.max_speed_m_s, Scenario{}.mission.max_speed_m_s);
  EXPECT_EQ(scenario.vehicle.tracking_error_m, Scenario{}.vehicle.tracking_error_m);
}

}  // namespace
}  // namespace flyball
