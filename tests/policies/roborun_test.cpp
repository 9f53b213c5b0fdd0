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

const BoundsLatency& bounded(const Policy& policy) {
  return dynamic_cast<const BoundsLatency&>(policy);
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

TEST_F(Roborun, has_more_time_the_slower_it_is_planned_to_fly) {
  Observation seen = in_the_open(6.2);
  const auto fast = start_policy("roborun", cubic(), knobs());
  const double fast_m = wish_of(*fast.policy, seen).resolution_m;
  seen.speed_m_s = 1.0;
  seen.max_deceleration_m_s2 = 3.0;  // So that its plan speeds up, and does not jump to 6 m/s.
  const auto slow = start_policy("roborun", cubic(), knobs());
  EXPECT_LT(wish_of(*slow.policy, seen).resolution_m, fast_m);
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

TEST_F(Roborun, looks_far_in_flight_where_its_fixed_stages_are_not_paid_for) {
  // A short range would keep the budget at nothing.
  Given given = cubic();
  given["fixed_s"] = 0.3;
  const auto roborun = start_policy("roborun", given, knobs());
  Observation seen = in_the_open(9.0);  // 1/4 s.
  seen.speed_m_s = 6.0;
  const Wish wish = wish_of(*roborun.policy, seen);
  EXPECT_GT(wish.resolution_m, 2.0);
  EXPECT_GT(wish.range_m, 20.0);
}

TEST_F(Roborun, has_all_the_time_there_is_while_it_stands_before_what_it_does_not_know) {
  // Were there none, its settings would stay and show no more than before.
  Given given = cubic();
  given["fixed_s"] = 0.3;
  const auto roborun = start_policy("roborun", given, knobs());
  const Wish wish = wish_of(*roborun.policy, in_the_open(0.0));
  EXPECT_NEAR(wish.resolution_m, 0.3, 1e-9);
  EXPECT_NEAR(wish.range_m, 25.0, 0.5);
}

TEST_F(Roborun, leaves_precision_to_space_where_it_may_not_be_finer_than_half_of_the_gaps) {
  Given given = cubic();
  given["gap_share"] = 0.5;
  for (const double free_m : {6.5, 18.0, 1000.0}) {
    for (const double gap_m : {1.0, 2.0, 3.0, 7.0}) {
      const auto roborun = start_policy("roborun", given, knobs());
      Observation seen = in_the_open(free_m);
      seen.mean_gap_m = gap_m;
      const double ceiling_m = 0.3 * std::exp2(std::floor(std::log2(gap_m / 0.3)));
      EXPECT_NEAR(wish_of(*roborun.policy, seen).resolution_m, ceiling_m, 1e-9)
          << free_m << ' ' << gap_m;
    }
  }
}

TEST_F(Roborun, remembers_the_narrowest_of_the_last_five_maps) {
  Given given = cubic();
  given["gap_share"] = 0.5;
  const auto roborun = start_policy("roborun", given, knobs());
  Observation seen = in_the_open(18.0);
  const auto map_with_gap = [&](double gap_m) {
    ++seen.map_revision;
    seen.mean_gap_m = gap_m;
    return wish_of(*roborun.policy, seen).resolution_m;
  };
  EXPECT_NEAR(map_with_gap(1.3), 1.2, 1e-9);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(map_with_gap(10.0), 1.2, 1e-9) << i;
  }
  EXPECT_NEAR(map_with_gap(10.0), 9.6, 1e-9);
}

TEST_F(Roborun, solves_for_no_cells_that_the_map_does_not_know) {
  KnobSettings coarse_to_1_2 = knobs();
  std::vector<KnobSpec> specs;
  for (const char* name : {"map.resolution_m", "map.range_m", "mission.max_speed_m_s"}) {
    specs.push_back(*coarse_to_1_2.spec(name));
  }
  specs.front().legal = {0.15, 0.3, 0.6, 1.2};
  specs.front().max = 1.2;
  Given given = cubic();
  given["gap_share"] = 0.5;
  const auto roborun = start_policy("roborun", given, KnobSettings{specs});
  EXPECT_NEAR(wish_of(*roborun.policy, in_the_open(18.0)).resolution_m, 1.2, 1e-9);
  EXPECT_EQ(bounded(*roborun.policy).bound_levels().size(), 3U);
}

TEST_F(Roborun, counts_maps_that_came_later_than_the_budget_of_their_frame) {
  using namespace std::chrono_literals;
  Given given = cubic();
  given["fixed_s"] = 0.3;
  const auto roborun = start_policy("roborun", given, knobs());
  Observation seen = in_the_open(18.0);  // 1 s.
  seen.speed_m_s = 6.0;
  seen.now = MissionTime{10s};
  (void)roborun.policy->decide(seen);
  const auto map_after = [&](Duration latency) {
    seen.now += 2s;
    ++seen.map_revision;
    seen.latency = latency;
    (void)roborun.policy->decide(seen);
    return bounded(*roborun.policy).bounds();
  };
  EXPECT_EQ(map_after(900ms).late, 0U);
  EXPECT_EQ(map_after(1100ms).late, 1U);
  EXPECT_EQ(bounded(*roborun.policy).bounds().issued, 2U);
  seen.known_free_m = 6.0;  // None from now on ...
  EXPECT_EQ(map_after(900ms).issued, 3U);
  EXPECT_EQ(map_after(900ms).issued, 3U) << "... and no bound to keep";
}

TEST_F(Roborun, is_at_most_a_metre_and_a_fifth_near_the_goal) {
  Given given = cubic();
  given["map_q0_s"] = 27.0 / (0.75 * 25.0 * 25.0 * 25.0);  // 1000 s at .3 m, 2 s at 2.4 m.
  const auto roborun = start_policy("roborun", given, knobs());
  Observation seen = in_the_open(18.0);
  EXPECT_GT(wish_of(*roborun.policy, seen).resolution_m, 2.0);
  seen.distance_to_goal_m = 39.0;
  ++seen.map_revision;
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
