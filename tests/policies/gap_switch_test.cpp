// SPDX-License-Identifier: BSD-3-Clause
#include "policy_start.h"
#include "started_policy.h"

#include <gtest/gtest.h>

namespace {

using flyball::start_policy;
using flyball::kit::wish_for;
using Given = std::map<std::string, flyball::ParameterValue>;

/// A vehicle in cruise with nothing near, seen in cells of .60 m.
flyball::Observation in_the_open(double t_s) {
  flyball::Observation seen;
  seen.now = flyball::MissionTime{flyball::from_seconds(t_s)};
  seen.phase = flyball::MissionPhase::cruise;
  seen.speed_m_s = 4.0;
  seen.speed_limit_m_s = 6.0;
  seen.map_resolution_m = 0.60;
  seen.nearest_obstacle_m = 20.0;
  seen.narrowest_gap_m = 24.0;
  seen.gap_distance_m = 24.0;
  return seen;
}

class GapSwitch : public ::testing::Test {
 protected:
  GapSwitch() : started_{start_policy("gap_switch", Given{{"body_m", 0.7}})} {}
  double cells_m(const flyball::Observation& seen) {
    const auto wish = started_.policy->decide(seen);
    range_m_ = *wish_for(wish, "map.range_m");
    EXPECT_FALSE(wish_for(wish, "planner.budget").has_value()) << "that is the mission's";
    return *wish_for(wish, "map.resolution_m");
  }
  flyball::StartedPolicy started_;
  double range_m_{};
};

TEST_F(GapSwitch, takes_the_largest_cells_that_leave_the_gap_open) {
  auto seen = in_the_open(0.0);
  EXPECT_EQ(0.60, cells_m(seen));
  EXPECT_EQ(22.0, range_m_);
  seen.narrowest_gap_m = 1.89;  // Less than body and two cells of .60 m.
  EXPECT_EQ(0.30, cells_m(seen));
  EXPECT_EQ(15.0, range_m_);
  seen.gap_distance_m = 5.0;
  seen.narrowest_gap_m = 1.29;
  EXPECT_EQ(0.15, cells_m(seen));
  EXPECT_EQ(10.0, range_m_);
}

TEST_F(GapSwitch, counts_what_larger_cells_would_take_from_a_gap_that_finer_ones_show) {
  auto seen = in_the_open(0.0);
  seen.map_resolution_m = 0.15;
  seen.narrowest_gap_m = 0.7 + 2.0 * 0.60 + 2.0 * 0.45;
  EXPECT_EQ(0.60, cells_m(seen));
  seen.narrowest_gap_m -= 0.01;
  EXPECT_EQ(0.30, cells_m(seen));
}

TEST_F(GapSwitch, looks_at_a_far_gap_on_the_second_level) {
  auto seen = in_the_open(0.0);
  seen.narrowest_gap_m = 0.5;
  seen.gap_distance_m = 8.5;
  EXPECT_EQ(0.30, cells_m(seen));
  seen.gap_distance_m = 7.5;
  EXPECT_EQ(0.15, cells_m(seen));
}

TEST_F(GapSwitch, keeps_the_finest_cells_until_the_gap_is_behind) {
  auto seen = in_the_open(0.0);
  seen.narrowest_gap_m = 0.5;
  seen.gap_distance_m = 5.0;  // With 3 m behind it, 2 s at 4 m/s.
  EXPECT_EQ(0.15, cells_m(seen));
  EXPECT_EQ(0.15, cells_m(in_the_open(1.9))) << "out of sight, and not yet behind";
  EXPECT_EQ(0.15, cells_m(in_the_open(2.1))) << "finer cells last for 2 s";
  EXPECT_EQ(0.60, cells_m(in_the_open(3.9)));
}

TEST_F(GapSwitch, does_not_put_the_vehicle_into_the_cells_of_an_obstacle) {
  auto seen = in_the_open(0.0);
  seen.planner_failures = 1;
  EXPECT_EQ(0.15, cells_m(seen));
  seen = in_the_open(10.0);
  seen.nearest_obstacle_m = 1.0;  // At least .35 m and two cells.
  EXPECT_EQ(0.30, cells_m(seen));
  seen = in_the_open(20.0);
  seen.nearest_obstacle_m = 1.6;
  EXPECT_EQ(0.60, cells_m(seen));
}

TEST_F(GapSwitch, within_a_narrow_place_keeps_the_cells_that_led_into_it) {
  auto seen = in_the_open(0.0);
  seen.speed_limit_m_s = 1.5;
  EXPECT_EQ(0.30, cells_m(seen)) << "before it";
  seen.planner_failures = 1;
  EXPECT_EQ(0.15, cells_m(seen));
  seen = in_the_open(60.0);
  seen.speed_limit_m_s = seen.speed_m_s = 1.5;
  EXPECT_EQ(0.15, cells_m(seen)) << "within";
  EXPECT_EQ(0.60, cells_m(in_the_open(120.0))) << "behind it";
}

TEST_F(GapSwitch, decides_sensibly_when_the_numbers_make_no_sense) {
  for (const flyball::Observation& seen : flyball::extreme_observations()) {
    const double chosen_m = cells_m(seen);
    EXPECT_TRUE(chosen_m == 0.15 || chosen_m == 0.30 || chosen_m == 0.60) << chosen_m;
  }
}

TEST(GapSwitchStart, refuses_a_mission_without_its_knobs) {
  const auto started = start_policy("gap_switch", {}, flyball::KnobSettings{});
  ASSERT_FALSE(started.status.ok());
  for (const char* knob : {"map.resolution_m", "map.range_m"}) {
    EXPECT_NE(std::string::npos, started.status.error().message.find(knob));
  }
}

}  // namespace
