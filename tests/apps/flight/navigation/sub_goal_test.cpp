// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/sub_goal.h"

#include "mission_rig.h"
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::GridMap;

const Vec3 start_W{0.0, 0.0, 1.5};
const Vec3 far_goal_W{200.0, 0.0, 1.5};

/// The first 60 m of a strip, 30 m wide.
struct Strip {
  explicit Strip(CellState everywhere = CellState::free)
      : map{{Vec3{-2.0, -15.0, 0.0}, Vec3{60.0, 15.0, 3.0}}, 0.3, everywhere} {}
  [[nodiscard]] Vec3 place(double horizon_m, int failures = 0) const {
    Scenario scenario = kit::MissionRig::one_core();
    scenario.planner.horizon_m = horizon_m;
    Site site;
    site.bounds_W = {Vec3{-10.0, -15.0, 1.0}, Vec3{210.0, 15.0, 2.0}};
    const kit::MissionRig rig{map, scenario, site};
    return sub_goal_W(rig.situation(), start_W, far_goal_W, failures);
  }
  GridMap map;
};

TEST(SubGoal, is_the_goal_itself_when_it_is_near_or_no_horizon_is_set) {
  EXPECT_EQ(Strip{}.place(0.0), far_goal_W);
  EXPECT_EQ(Strip{}.place(200.0), far_goal_W);
}

TEST(SubGoal, lies_on_the_straight_line_at_the_horizon) {
  EXPECT_NEAR((Strip{}.place(40.0) - Vec3{40.0, 0.0, 1.5}).norm(), 0.0, 1e-9);
}

TEST(SubGoal, is_not_where_the_body_cannot_be) {
  Strip strip;
  strip.map.fill({{38.0, -2.0, 0.0}, {42.0, 2.0, 3.0}}, CellState::occupied);
  const Vec3 place_W = strip.place(40.0);
  EXPECT_LT(place_W.x(), 37.7);
  EXPECT_GT(place_W.x(), 30.0);
  EXPECT_EQ(place_W.y(), 0.0);
}

TEST(SubGoal, is_not_in_the_unknown_inside_of_a_block) {
  Strip strip;
  strip.map.fill({{38.0, -2.0, 0.0}, {42.0, 2.0, 3.0}}, CellState::occupied);
  strip.map.fill({{38.3, -1.7, 0.0}, {41.7, 1.7, 3.0}}, CellState::unknown);
  EXPECT_LT(strip.place(40.0).x(), 37.7);
}

TEST(SubGoal, is_another_place_after_each_failure) {
  const Strip strip;
  for (int failures = 0; failures < 10; ++failures) {
    EXPECT_GT((strip.place(40.0, failures) - strip.place(40.0, failures + 1)).norm(), 1.0);
  }
  EXPECT_EQ(strip.place(40.0, 1000), far_goal_W) << "when every place has been tried";
}

/// Along the strip, place by place.
std::vector<Vec3> flown_leg_W(const kit::GridMap& map) {
  const kit::MissionRig rig{map};
  std::vector<Vec3> flown_W;
  for (int i = 0; i <= 500; ++i) {
    flown_W.push_back(Vec3{0.1 * i, 0.0, 1.5});
  }
  return free_leg_W(rig.situation(), flown_W);
}

TEST(FreeLeg, is_the_whole_way_where_that_is_free) {
  EXPECT_EQ(flown_leg_W(Strip{}.map).size(), 501U);
}

TEST(FreeLeg, ends_before_what_blocks_the_way) {
  Strip strip;
  strip.map.fill({{40.0, -2.0, 0.0}, {42.0, 2.0, 3.0}}, CellState::occupied);
  const auto leg_W = flown_leg_W(strip.map);
  ASSERT_FALSE(leg_W.empty());
  EXPECT_LT(leg_W.back().x(), 40.0);
  EXPECT_GT(leg_W.back().x(), 39.0);
}

TEST(FreeLeg, is_none_where_the_way_is_blocked_near_by_or_there_is_none) {
  Strip strip;
  strip.map.fill({{4.0, -2.0, 0.0}, {6.0, 2.0, 3.0}}, CellState::occupied);
  EXPECT_TRUE(flown_leg_W(strip.map).empty());
  const kit::MissionRig rig{strip.map};
  EXPECT_TRUE(free_leg_W(rig.situation(), {}).empty());
}

}  // namespace
}  // namespace flyball
