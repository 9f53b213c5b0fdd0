// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/governors/energy_search.h"

#include "flyball/governors/policy_conformance.h"

#include "search_knobs.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double top_hz = 2e9;

KnobSettings knobs() {
  return kit::search_knobs({0.5e9, 1e9, top_hz});
}

PowerCost power() {
  return *conformance_board().power;
}

EnergySearch search(double fine_most_range_m = 25.0) {
  const std::vector<SearchLevel> levels{{0.15, 0.5, 2.2, fine_most_range_m, 7.0, top_hz},
                                        {0.80, 0.1, 1.0, 25.0, 7.0, top_hz}};
  return *EnergySearch::make({}, levels, {7.0, 12.0}, knobs(), power());
}

Surroundings open_space() {
  Surroundings around;
  around.speed_limit_m_s = 10.0;
  around.visibility_m = 1e9;
  around.coarsest_m = 0.80;
  return around;
}

/// What the map shows at a time of its newest frame.
Observation seen_map(double t_s, std::uint64_t revision, double resolution_m, double latency_s) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.map_revision = revision;
  seen.map_resolution_m = resolution_m;
  seen.latency = from_seconds(latency_s);
  seen.frequency = Hertz{top_hz};
  seen.busy_cores = 2.0;
  return seen;
}

TEST(EnergySearch, in_the_open_flies_coarse_far_and_fast) {
  EnergySearch one = search();
  const EnergyEstimate best = one.choose(open_space(), {});
  EXPECT_EQ(best.setting.resolution_m, 0.80);
  EXPECT_EQ(best.setting.range_m, 12.0);
  EXPECT_EQ(best.setting.clock_hz, top_hz);
  EXPECT_EQ(one.in_force(), best.setting);
}

TEST(EnergySearch, reaches_as_far_as_it_must_where_a_level_can) {
  EnergySearch one = search();
  Surroundings around = open_space();
  around.coarsest_m = 0.15;
  around.visibility_m = 7.0;  // Nothing to win beyond.
  EXPECT_EQ(one.choose(around, {}).setting.range_m, 7.0);
  around.least_range_m = 11.0;
  EXPECT_EQ(one.choose(around, {}).setting.range_m, 12.0);
  around.least_range_m = 50.0;
  EXPECT_EQ(one.choose(around, {}).setting.range_m, 7.0);
}

TEST(EnergySearch, looks_no_farther_than_it_pays) {
  EnergySearch one = search();
  Surroundings around = open_space();
  around.coarsest_m = 0.15;
  around.speed_limit_m_s = 1.0;  // Every setting is fast enough, so the soonest one.
  const EnergyEstimate best = one.choose(around, {});
  EXPECT_EQ(best.setting.range_m, 7.0);
  for (std::size_t i = 0; i < one.points().size(); ++i) {
    const double* at = one.points().values(i);
    const EnergyEstimate other = one.estimate({at[0], at[1], at[2]}, around);
    EXPECT_TRUE(at[0] > 0.15 || best.joules_per_m <= 1.001 * other.joules_per_m);
  }
}

TEST(EnergySearch, brakes_as_the_mission_does) {
  const EnergySearch one = search();
  Surroundings around = open_space();
  const double usual_m_s = one.estimate({0.80, 12.0, top_hz}, around).speed_m_s;
  around.deceleration_m_s2 = 2.0;
  EXPECT_LT(one.estimate({0.80, 12.0, top_hz}, around).speed_m_s, usual_m_s);
}

TEST(EnergySearch, its_choice_is_the_best_of_all_that_are_allowed) {
  EnergySearch one = search();
  Surroundings around = open_space();
  around.coarsest_m = 0.15;
  const EnergyEstimate best = one.choose(around, {});
  EXPECT_EQ(best.setting.resolution_m, 0.15);
  for (std::size_t i = 0; i < one.points().size(); ++i) {
    const double* at = one.points().values(i);
    if (at[0] <= around.coarsest_m) {
      EXPECT_LE(best.joules_per_m,
                1.001 * one.estimate({at[0], at[1], at[2]}, around).joules_per_m);
    }
  }
}

TEST(EnergySearch, its_speed_is_that_of_equation_2_for_its_response) {
  EnergySearch one = search();
  const EnergyEstimate best = one.choose(open_space(), {});
  const double d_m =
      best.setting.range_m - best.setting.resolution_m - EnergySearchSettings{}.margin_m;
  EXPECT_DOUBLE_EQ(best.speed_m_s, SpeedLimit{6.0}.speed_m_s(best.response_s, d_m));
  EXPECT_GT(best.watts_per_second, 0.0);
}

TEST(EnergySearch, at_the_missions_own_limit_latency_is_worth_nothing_and_the_clock_drops) {
  EnergySearch one = search();
  Surroundings slow = open_space();
  slow.speed_limit_m_s = 1.0;
  const EnergyEstimate best = one.choose(slow, {});
  EXPECT_EQ(best.watts_per_second, 0.0);
  EXPECT_LT(best.setting.clock_hz, top_hz);
  EXPECT_EQ(best.speed_m_s, 1.0);
  slow.needs_top_clock = true;
  EXPECT_EQ(one.choose(slow, {}).setting.clock_hz, top_hz);
}

TEST(EnergySearch, of_settings_that_are_equally_cheap_takes_the_one_that_responds_sooner) {
  EnergySearch one = search();
  Surroundings slow = open_space();
  slow.speed_limit_m_s = 1.0;
  slow.coarsest_m = 0.15;
  slow.needs_top_clock = true;
  EXPECT_EQ(one.choose(slow, {}).setting.range_m, 7.0);
}

TEST(EnergySearch, a_range_buys_nothing_beyond_what_the_world_lets_see) {
  EnergySearch one = search();
  Surroundings walled = open_space();
  walled.visibility_m = 6.0;
  EXPECT_EQ(one.choose(walled, {}).setting.range_m, 7.0);
}

TEST(EnergySearch, looks_farther_than_a_level_allows_where_the_gaps_ahead_are_wide) {
  Surroundings around = open_space();
  around.coarsest_m = 0.15;
  around.speed_limit_m_s = 1.0;
  around.least_range_m = 12.0;
  EXPECT_EQ(search(7.0).choose(around, {}).setting.range_m, 7.0);
  around.clear_range_m = 12.0;
  EXPECT_EQ(search(7.0).choose(around, {}).setting.range_m, 12.0);
}

TEST(EnergySearch, keeps_to_the_range_that_it_may_use) {
  EnergySearch one = search();
  Surroundings near = open_space();
  near.most_range_m = 1.0;  // less than there is: the shortest
  EXPECT_EQ(one.choose(near, {}).setting.range_m, 7.0);
}

TEST(EnergySearch, learns_that_the_computer_is_slower_than_was_said) {
  EnergySearch one = search();
  double t_s = 0.0;
  const double before_m_s = one.choose(open_space(), {}).speed_m_s;
  for (std::uint64_t i = 1; i <= 60; ++i) {
    t_s += 1.0;
    one.learn(seen_map(t_s, i, 0.80, 0.6));
    static_cast<void>(one.choose(open_space(), MissionTime{from_seconds(t_s)}));
  }
  const EnergyEstimate after = one.estimate(one.in_force(), open_space());
  EXPECT_LT(after.speed_m_s, before_m_s);
  // Twice a latency of .6 s, and .14 s.
  EXPECT_GT(after.response_s, 1.2);
  EXPECT_LT(after.response_s, 2.2);
}

EnergySearch search_with(const EnergySearchSettings& settings) {
  const std::vector<SearchLevel> levels{{0.15, 0.5, 2.2, 25.0, 7.0, top_hz},
                                        {0.80, 0.1, 1.0, 25.0, 7.0, top_hz}};
  return *EnergySearch::make(settings, levels, {7.0, 12.0}, knobs(), power());
}

EnergySearch search_bounded_by(double factor) {
  EnergySearchSettings settings;
  settings.bound.first = std::log(factor);
  return search_with(settings);
}

TEST(EnergySearch, compares_by_the_predicted_latency_and_not_by_its_bound) {
  EnergySearch narrow = search_bounded_by(1.0);
  EnergySearch wide = search_bounded_by(4.0);
  const EnergyEstimate one = narrow.choose(open_space(), {});
  const EnergyEstimate other = wide.choose(open_space(), {});
  EXPECT_EQ(one.setting, other.setting);
  EXPECT_EQ(one.response_s, other.response_s);
  EXPECT_EQ(one.joules_per_m, other.joules_per_m);
}

TEST(EnergySearch, leaves_out_what_responds_later_than_is_allowed) {
  Surroundings around = open_space();
  EXPECT_EQ(search().choose(around, {}).setting.range_m, 12.0);
  around.most_response_s = 0.4;  // The coarse cells take .10 s at 7 m and .17 s at 12 m, twice.
  EXPECT_EQ(search().choose(around, {}).setting.range_m, 7.0);
}

TEST(EnergySearch, does_not_learn_from_a_frame_of_the_setting_before) {
  EnergySearch one = search();
  static_cast<void>(one.choose(open_space(), MissionTime{from_seconds(10.0)}));
  const double before_s = one.estimate(one.in_force(), open_space()).response_s;
  one.learn(seen_map(10.2, 1, 0.80, 5.0));  // captured at 5.2 s
  one.learn(seen_map(10.4, 2, 0.15, 0.1));  // of another level
  EXPECT_EQ(one.estimate(one.in_force(), open_space()).response_s, before_s);
}

TEST(EnergySearch, learns_from_a_frame_of_the_range_before_what_that_range_takes) {
  EnergySearch one = search();
  one.put_in_force({0.80, 12.0, top_hz}, MissionTime{from_seconds(1.0)});
  one.put_in_force({0.80, 7.0, top_hz}, MissionTime{from_seconds(10.0)});
  const double before_s = one.estimate({0.80, 12.0, top_hz}, open_space()).response_s;
  Observation late = seen_map(10.2, 1, 0.80, 5.0);  // Captured at 5.2 s.
  for (const double absurd_m : {-1.0, 0.0, 1e-300, 1e300, std::nan("")}) {
    late.map_range_m = absurd_m;
    late.map_revision += 10;
    one.learn(late);
    EXPECT_EQ(one.estimate({0.80, 12.0, top_hz}, open_space()).response_s, before_s) << absurd_m;
  }
  late.map_range_m = 12.0;
  late.map_revision = 1;
  one.learn(late);
  const double after_s = one.estimate({0.80, 12.0, top_hz}, open_space()).response_s;
  EXPECT_GT(after_s, 2.0 * before_s);
  one.put_in_force({0.15, 7.0, top_hz}, MissionTime{from_seconds(11.0)});
  one.put_in_force({0.80, 7.0, top_hz}, MissionTime{from_seconds(12.0)});
  Observation rebuilt = seen_map(12.5, 2, 0.80, 50.0);  // Captured with smaller cells in force.
  rebuilt.map_range_m = 12.0;
  one.learn(rebuilt);
  EXPECT_EQ(one.estimate({0.80, 12.0, top_hz}, open_space()).response_s, after_s);
}

TEST(EnergySearch, counts_a_map_that_never_comes_as_a_miss) {
  EnergySearch one = search();
  static_cast<void>(one.choose(open_space(), MissionTime{from_seconds(1.0)}));
  one.learn(seen_map(2.0, 1, 0.80, 0.1));
  one.learn(seen_map(3.0, 1, 0.80, 0.1));
  EXPECT_EQ(one.bound().tracker(1).misses(), 1U);
  EXPECT_EQ(one.bound().tracker(0).decisions(), 0U);
}

TEST(EnergySearch, refuses_what_no_knob_can_be) {
  const std::vector<SearchLevel> levels{{5.0, 0.5, 2.2, 25.0, 7.0, top_hz}};
  EXPECT_FALSE(EnergySearch::make({}, levels, {7.0}, knobs(), power()).ok());
  EXPECT_FALSE(
      EnergySearch::make({}, {{0.15, 0.5, 2.2, 25.0, 7.0, top_hz}}, {7.0}, {}, power()).ok());
}

/// Maps of .8 m, one in each of `n` looks, `period_s` apart.
void see_maps(EnergySearch& one, int n, double period_s, double latency_s, double from_s = 1.0) {
  for (int i = 0; i < n; ++i) {
    const double t_s = from_s + i * period_s;
    one.learn(seen_map(t_s, static_cast<std::uint64_t>(t_s * 1e3), 0.80, latency_s));
    (void)one.choose(open_space(), MissionTime{from_seconds(t_s)});
  }
}

TEST(EnergySearch, a_map_that_was_quick_is_in_time_however_seldom_it_is_looked_for) {
  EnergySearch one = search();
  see_maps(one, 100, 0.25, 0.01);
  EXPECT_GT(one.bounds().issued, 90U);
  EXPECT_LT(one.bounds().late, 8U);
}

TEST(EnergySearch, keeps_its_bounds_apart_by_level) {
  EnergySearch one = search();
  see_maps(one, 100, 0.25, 0.01);
  std::uint64_t issued = 0;
  for (const LevelBounds& level : one.bound_levels()) {
    issued += level.issued;
    EXPECT_EQ(level.issued > 0, level.resolution_m == 0.80) << level.resolution_m;
    ASSERT_TRUE(level.most_late);
    EXPECT_LE(static_cast<double>(level.late), *level.most_late);
  }
  EXPECT_EQ(issued, one.bounds().issued);
}

TEST(EnergySearch, a_map_that_does_not_come_is_late_once) {
  EnergySearch one = search();
  see_maps(one, 20, 0.25, 0.1);
  const BoundCount before = one.bounds();
  Observation seen = seen_map(6.0, 5750, 0.80, 0.1);  // The last map that was seen.
  for (int i = 0; i < 8; ++i) {
    seen.now += std::chrono::milliseconds{250};
    one.learn(seen);
  }
  EXPECT_EQ(one.bounds().issued, before.issued + 1);
  EXPECT_EQ(one.bounds().late, before.late + 1);
}

TEST(EnergySearch,
     with_a_constant_margin_is_late_for_good_when_costs_triple_and_nothing_is_learned) {
  EnergySearchSettings once;
  once.bound.eta = 0.0;
  once.bound.first = std::log(1.3);
  once.learn_s = 26.0;
  EnergySearch kept = search_with(once);
  EnergySearch calibrated = search_with({});
  for (EnergySearch* one : {&kept, &calibrated}) {
    see_maps(*one, 100, 0.25, 0.1);
    const BoundCount calm = one->bounds();
    EXPECT_LE(calm.late, 10U);
    see_maps(*one, 50, 0.5, 0.3, 30.0);
    const BoundCount settled = one->bounds();
    see_maps(*one, 200, 0.5, 0.3, 60.0);
    const auto late = one->bounds().late - settled.late;
    const auto issued = one->bounds().issued - settled.issued;
    ASSERT_GT(issued, 190U);
    if (one == &kept) {
      EXPECT_EQ(late, issued);
      EXPECT_DOUBLE_EQ(one->bounds().factor, 1.3);
    } else {
      EXPECT_LE(static_cast<double>(late), 0.1 * static_cast<double>(issued));
    }
  }
}

TEST(EnergySearch, a_slower_clock_than_asked_for_moves_the_bound) {
  EnergySearchSettings constant;
  constant.bound.eta = 0.0;
  constant.bound.first = std::log(1.3);
  EnergySearch one = search_with(constant);
  see_maps(one, 40, 0.25, 0.1);
  const BoundCount before = one.bounds();
  for (int i = 0; i < 10; ++i) {
    Observation seen = seen_map(20.0 + 0.5 * i, static_cast<std::uint64_t>(90000 + i), 0.80, 0.19);
    seen.frequency = Hertz{0.5 * top_hz};  // .9 / 1 + .05 instead of .9 / 2 + .05: 1.9 times.
    one.learn(seen);
    (void)one.choose(open_space(), seen.now);
  }
  EXPECT_GE(one.bounds().issued, before.issued + 9);
  EXPECT_EQ(one.bounds().late, before.late);
}

}  // namespace
}  // namespace flyball
