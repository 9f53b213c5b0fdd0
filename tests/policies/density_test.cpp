// SPDX-License-Identifier: BSD-3-Clause
#include "started_policy.h"

#include <gtest/gtest.h>

namespace {

using flyball::start_policy;
using Given = std::map<std::string, flyball::ParameterValue>;

/// Thresholds of the test's own, so that it says which value decides; the defaults are further
/// down.
const Given two_levels{{"fine_m", 0.15},
                       {"coarse_m", 0.80},
                       {"enter_density", 0.05},
                       {"leave_density", 0.03},
                       {"min_fine_s", 5.0}};

/// The resolution that it wishes at a time for a density.
double resolution_m(flyball::Policy& policy, double t_s, double density) {
  flyball::Observation seen;
  seen.now = flyball::MissionTime{flyball::from_seconds(t_s)};
  seen.obstacle_density = density;
  const auto decision = policy.decide(seen);
  EXPECT_EQ(1U, decision.size());
  EXPECT_EQ("map.resolution_m", decision.begin()->knob);
  EXPECT_EQ(flyball::Reason::density, decision.reason);
  return decision.begin()->value;
}

TEST(Density, is_coarse_in_the_open_and_fine_among_obstacles) {
  const auto density = start_policy("density", two_levels);
  ASSERT_TRUE(density.status.ok());
  EXPECT_EQ(0.80, resolution_m(*density.policy, 0.0, 0.0));
  EXPECT_EQ(0.80, resolution_m(*density.policy, 1.0, 0.025));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 2.0, 0.07));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 30.0, 0.16));
  EXPECT_EQ(0.80, resolution_m(*density.policy, 60.0, 0.0));
}

TEST(Density, does_not_flutter_between_its_two_thresholds) {
  const auto density = start_policy("density", two_levels);
  EXPECT_EQ(0.80, resolution_m(*density.policy, 0.0, 0.049));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 10.0, 0.050));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 20.0, 0.031));
  EXPECT_EQ(0.80, resolution_m(*density.policy, 30.0, 0.030));
  EXPECT_EQ(0.80, resolution_m(*density.policy, 40.0, 0.049));
}

TEST(Density, goes_with_a_range_of_its_own_at_each_level_when_it_is_given_one) {
  Given given = two_levels;
  given["coarse_range_m"] = 20.0;
  const auto density = start_policy("density", given);
  ASSERT_TRUE(density.status.ok());
  flyball::Observation seen;
  const auto range_m = [&](double obstacles) {
    seen.now += std::chrono::seconds{10};
    seen.obstacle_density = obstacles;
    const auto wish = density.policy->decide(seen);
    EXPECT_EQ(2U, wish.size());
    EXPECT_EQ("map.range_m", wish.begin()[1].knob);
    return wish.begin()[1].value;
  };
  EXPECT_EQ(20.0, range_m(0.0));
  EXPECT_EQ(7.0, range_m(0.2)) << "the scenario's";
  EXPECT_EQ(20.0, range_m(0.0));
}

TEST(Density, stays_fine_for_its_minimum_time) {
  const auto density = start_policy("density", two_levels);
  EXPECT_EQ(0.15, resolution_m(*density.policy, 10.0, 0.2));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 14.99, 0.0));
  EXPECT_EQ(0.80, resolution_m(*density.policy, 15.0, 0.0));
}

TEST(Density, is_fine_after_three_failed_plans_in_a_row_until_one_succeeds) {
  const auto density = start_policy("density", two_levels);
  flyball::Observation seen;
  const auto after = [&](double t_s, std::uint32_t failures) {
    seen.now = flyball::MissionTime{flyball::from_seconds(t_s)};
    seen.planner_failures = failures;
    return density.policy->decide(seen).begin()->value;
  };
  EXPECT_EQ(0.80, after(0.0, 2));
  EXPECT_EQ(0.15, after(1.0, 3));
  EXPECT_EQ(0.15, after(20.0, 4)) << "the minimum time is over";
  EXPECT_EQ(0.15, after(34.0, 0)) << "the plan that was found leads to what coarse cells close";
  EXPECT_EQ(0.80, after(36.0, 0));
}

TEST(Density, after_failed_plans_stays_fine_for_as_long_as_it_is_told) {
  Given given = two_levels;
  given["stuck_fine_s"] = 0.0;
  const auto density = start_policy("density", given);
  flyball::Observation seen;
  seen.planner_failures = 3;
  EXPECT_EQ(0.15, density.policy->decide(seen).begin()->value);
  seen.planner_failures = 0;
  seen.now = flyball::MissionTime{flyball::from_seconds(5.5)};  // `min_fine_s` is over.
  EXPECT_EQ(0.80, density.policy->decide(seen).begin()->value);
}

TEST(Density, can_be_told_not_to_care_about_failed_plans) {
  Given given = two_levels;
  given["failures_to_fine"] = 0.0;
  const auto density = start_policy("density", given);
  flyball::Observation seen;
  seen.planner_failures = 9;
  EXPECT_EQ(0.80, density.policy->decide(seen).begin()->value);
}

TEST(Density, keeps_its_level_when_the_density_is_not_a_number) {
  const auto density = start_policy("density", two_levels);
  EXPECT_EQ(0.80, resolution_m(*density.policy, 0.0, std::nan("")));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 1.0, 0.2));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 30.0, std::nan("")));
}

TEST(Density, tells_a_single_block_from_a_facade_and_a_room_by_default) {
  const auto density = start_policy("density", {});
  ASSERT_TRUE(density.status.ok());
  EXPECT_EQ(0.80, resolution_m(*density.policy, 0.0, 0.051));   // beside a single block, at most
  EXPECT_EQ(0.15, resolution_m(*density.policy, 10.0, 0.068));  // 4 m before a facade
  EXPECT_EQ(0.15, resolution_m(*density.policy, 20.0, 0.085));  // in a room, at least
  EXPECT_EQ(0.80, resolution_m(*density.policy, 30.0, 0.034));  // beside a single block again
}

TEST(Density, by_default_enters_at_06_leaves_at_045_and_stays_fine_for_2_s) {
  const auto density = start_policy("density", {});
  EXPECT_EQ(0.80, resolution_m(*density.policy, 0.0, 0.0599));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 1.0, 0.06));
  EXPECT_EQ(0.15, resolution_m(*density.policy, 2.99, 0.045));  // too early
  EXPECT_EQ(0.15, resolution_m(*density.policy, 3.0, 0.0451));
  EXPECT_EQ(0.80, resolution_m(*density.policy, 3.0, 0.045));
}

TEST(Density, refuses_levels_and_thresholds_in_the_wrong_order) {
  EXPECT_FALSE(start_policy("density", {{"fine_m", 0.80}, {"coarse_m", 0.15}}).status.ok());
  EXPECT_FALSE(start_policy("density", {{"fine_m", 0.30}, {"coarse_m", 0.30}}).status.ok());
  EXPECT_FALSE(
      start_policy("density", {{"enter_density", 0.05}, {"leave_density", 0.06}}).status.ok());
  EXPECT_TRUE(
      start_policy("density", {{"enter_density", 0.05}, {"leave_density", 0.05}}).status.ok());
}

TEST(Density, refuses_a_mission_without_a_map) {
  const auto density = start_policy("density", {}, flyball::KnobSettings{});
  ASSERT_FALSE(density.status.ok());
  EXPECT_NE(std::string::npos, density.status.error().message.find("map.resolution_m"));
}

}  // namespace
