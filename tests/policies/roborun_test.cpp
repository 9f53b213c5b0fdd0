// SPDX-License-Identifier: BSD-3-Clause
#include "started_policy.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Given = std::map<std::string, ParameterValue>;

/// Latencies of the test's own: 1 s at .3 m for the whole view of 25 m, an eighth for each
/// doubling.
Given cubic() {
  const double view_m3 = 0.75 * 25.0 * 25.0 * 25.0;
  return {{"map_q0_s", 0.027 / view_m3}, {"map_q1_s", 0.0},   {"map_q2_s", 0.0},
          {"planner_share", 0.0},        {"overhead_s", 0.0}, {"fixed_s", 0.0}};
}

KnobSettings knobs() {
  KnobSpec resolution;
  resolution.name = "map.resolution_m";
  resolution.max = 10.0;
  resolution.fallback = 0.6;
  KnobSpec range;
  range.name = "map.range_m";
  range.max = 25.0;
  range.fallback = 7.0;
  KnobSpec speed;
  speed.name = "mission.max_speed_m_s";
  speed.max = 6.0;
  speed.fallback = 6.0;
  return KnobSettings{{resolution, range, speed}};
}

Observation in_the_open(double known_free_m) {
  Observation seen;
  seen.known_free_m = known_free_m;
  seen.nearest_obstacle_m = 20.0;
  seen.mean_gap_m = 10.0;
  seen.distance_to_goal_m = 300.0;
  return seen;
}

struct Wish {
  double resolution_m{};
  double range_m{};
  double speed_m_s{};
};

Wish wish_of(Policy& policy, const Observation& seen) {
  Wish wish;
  for (const auto& [knob, value] : policy.decide(seen)) {
    (knob == "map.resolution_m" ? wish.resolution_m
     : knob == "map.range_m"    ? wish.range_m
                                : wish.speed_m_s) = value;
  }
  return wish;
}

class Roborun : public testing::Test {
 protected:
  void SetUp() override {
    Registry registry;
    register_policies(registry);
    if (registry.make<Policy>("roborun") == nullptr) {
      GTEST_SKIP() << "built without NLopt";
    }
  }
};

TEST_F(Roborun, commands_its_largest_speed_whatever_it_sees) {
  const auto roborun = start_policy("roborun", cubic(), knobs());
  ASSERT_TRUE(roborun.status.ok());
  for (const double free_m : {0.0, 3.0, 24.0}) {
    EXPECT_EQ(wish_of(*roborun.policy, in_the_open(free_m)).speed_m_s, 6.0);
  }
}

TEST_F(Roborun, fills_its_budget) {
  // t = (d - v^2 / 2 a) / 2 v, with v = 6 and a = 3: 1 s for d = 18 m, so .3 m and the whole view.
  const auto roborun = start_policy("roborun", cubic(), knobs());
  const Wish wish = wish_of(*roborun.policy, in_the_open(18.0));
  EXPECT_NEAR(wish.resolution_m, 0.3, 1e-9);
  EXPECT_NEAR(wish.range_m, 25.0, 0.5);
}

TEST_F(Roborun, is_coarser_the_less_it_knows) {
  const auto roborun = start_policy("roborun", cubic(), knobs());
  double before_m = 0.0;
  for (const double free_m : {18.0, 8.0, 6.2}) {
    const double now_m = wish_of(*roborun.policy, in_the_open(free_m)).resolution_m;
    EXPECT_GE(now_m, before_m) << free_m;
    before_m = now_m;
  }
  EXPECT_GT(before_m, 0.5);
}

TEST_F(Roborun, cuts_the_volume_where_a_gap_forbids_coarser_cells) {
  const auto roborun = start_policy("roborun", cubic(), knobs());
  Observation narrow = in_the_open(8.0);  // A budget of 1/6 s.
  narrow.nearest_obstacle_m = 0.5;
  const Wish wish = wish_of(*roborun.policy, narrow);
  EXPECT_NEAR(wish.resolution_m, 0.3, 1e-9);
  // The volume's own weight takes it a little beyond the budget.
  EXPECT_NEAR(wish.range_m, 25.0 * std::cbrt(1.0 / 6.0), 0.8);
}

TEST_F(Roborun, keeps_looking_far_where_it_knows_nothing) {
  // With no budget left cells are coarse; a short range too would keep the budget at nothing.
  const auto roborun = start_policy("roborun", cubic(), knobs());
  const Wish wish = wish_of(*roborun.policy, in_the_open(1.0));
  EXPECT_GT(wish.resolution_m, 2.0);
  EXPECT_GT(wish.range_m, 20.0);
}

TEST_F(Roborun, is_at_most_a_metre_and_a_fifth_near_the_goal) {
  Given given = cubic();
  given["map_q0_s"] = 27.0 / (0.75 * 25.0 * 25.0 * 25.0);  // 1000 s at .3 m, 2 s at 2.4 m.
  const auto roborun = start_policy("roborun", given, knobs());
  Observation seen = in_the_open(18.0);
  EXPECT_GT(wish_of(*roborun.policy, seen).resolution_m, 2.0);
  seen.distance_to_goal_m = 39.0;
  EXPECT_NEAR(wish_of(*roborun.policy, seen).resolution_m, 1.2, 1e-9);
}

TEST_F(Roborun, is_finest_after_two_failed_plans) {
  const auto roborun = start_policy("roborun", cubic(), knobs());
  Observation seen = in_the_open(6.2);
  seen.planner_failures = 1;
  EXPECT_GT(wish_of(*roborun.policy, seen).resolution_m, 0.5);
  seen.planner_failures = 2;
  EXPECT_EQ(wish_of(*roborun.policy, seen).resolution_m, 0.3);
}

TEST_F(Roborun, takes_its_own_overhead_off_the_budget) {
  Given given = cubic();
  given["overhead_s"] = 0.9;
  const auto with = start_policy("roborun", given, knobs());
  const auto without = start_policy("roborun", cubic(), knobs());
  EXPECT_GT(wish_of(*with.policy, in_the_open(18.0)).resolution_m,
            wish_of(*without.policy, in_the_open(18.0)).resolution_m);
}

}  // namespace
}  // namespace flyball
