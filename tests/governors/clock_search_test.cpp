// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone

#include "flyball/governors/clock_search.h"

#include "flyball/governors/policy_conformance.h"

#include "search_knobs.h"
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double top_hz = 2e9;
constexpr MapSetting fine{0.15, 7.0, 0.0};
constexpr MapSetting coarse{0.80, 12.0, 0.0};

ClockSearch search(const ClockSearchSettings& settings = {}) {
  return *ClockSearch::make(settings, {{0.15, 0.4, 2.2}, {0.80, 0.1, 1.0}},
                            kit::search_knobs({0.25e9, 0.5e9, 1e9, 1.5e9, top_hz}),
                            *conformance_board().power);
}

/// A vehicle in the open, which is as fast as it may be.
Observation in_the_open(double speed_limit_m_s) {
  Observation seen;
  seen.now = MissionTime{from_seconds(1.0)};
  seen.phase = MissionPhase::cruise;
  seen.speed_m_s = seen.speed_limit_m_s = speed_limit_m_s;
  seen.max_deceleration_m_s2 = 6.0;
  seen.known_free_m = 30.0;
  seen.narrowest_gap_m = 24.0;
  return seen;
}

double chosen_hz(const MapSetting& map, const Observation& seen, bool needs_top = false) {
  return search().choose(map, seen, needs_top).clock_hz;
}

TEST(ClockSearch, keeps_the_map_that_it_is_given) {
  ClockSearch one = search();
  const MapSetting best = one.choose(coarse, in_the_open(10.0), false);
  EXPECT_EQ(best.resolution_m, coarse.resolution_m);
  EXPECT_EQ(best.range_m, coarse.range_m);
  EXPECT_EQ(one.in_force(), best);
}

TEST(ClockSearch, is_at_the_top_where_latency_limits_the_speed_and_lower_where_the_mission_does) {
  EXPECT_EQ(chosen_hz(fine, in_the_open(20.0)), top_hz);
  EXPECT_LT(chosen_hz(coarse, in_the_open(1.0)), top_hz);
  EXPECT_EQ(chosen_hz(coarse, in_the_open(1.0), true), top_hz) << "asked for";
}

TEST(ClockSearch, keeps_the_top_where_something_beside_the_map_holds_the_vehicle_up) {
  Observation stands = in_the_open(1.0);
  stands.speed_m_s = 0.0;
  EXPECT_EQ(chosen_hz(coarse, stands), top_hz);
}

TEST(ClockSearch, takes_the_top_where_no_energy_is_finite) {
  PowerCost power = *conformance_board().power;
  power.core_cubic_w = 1.7e308;
  ClockSearch one = *ClockSearch::make({}, {{0.15, 0.4, 2.2}, {0.80, 0.1, 1.0}},
                                       kit::search_knobs({0.5e9, 1e9, top_hz}), power);
  EXPECT_EQ(one.choose(coarse, in_the_open(0.01), false).clock_hz, top_hz);
}

TEST(ClockSearch, takes_no_more_than_a_thousandth_above_the_least_energy_of_a_metre) {
  for (const double limit_m_s : {1.0, 3.0, 6.0, 12.0}) {
    ClockSearch one = search();
    const Observation seen = in_the_open(limit_m_s);
    const MapSetting best = one.choose(coarse, seen, false);
    const double best_j = one.estimate(best, surroundings_of(seen)).joules_per_m;
    for (const double clock_hz : one.clocks_hz()) {
      const MapSetting other{coarse.resolution_m, coarse.range_m, clock_hz};
      const double other_j = one.estimate(other, surroundings_of(seen)).joules_per_m;
      EXPECT_LE(best_j, 1.001 * other_j) << limit_m_s;
      EXPECT_TRUE(clock_hz <= best.clock_hz || other_j > best_j) << "the highest of its equals";
    }
  }
}

TEST(ClockSearch, keeps_the_top_where_no_lower_clock_saves_as_much_as_it_is_told) {
  const Observation seen = in_the_open(1.0);
  const ClockSearch one = search();
  double least_j = std::numeric_limits<double>::infinity();
  for (const double clock_hz : one.clocks_hz()) {
    const MapSetting other{coarse.resolution_m, coarse.range_m, clock_hz};
    least_j = std::min(least_j, one.estimate(other, surroundings_of(seen)).joules_per_m);
  }
  const MapSetting top{coarse.resolution_m, coarse.range_m, top_hz};
  const double saving = one.estimate(top, surroundings_of(seen)).joules_per_m / least_j - 1.0;
  ASSERT_GT(saving, 0.001);
  ClockSearchSettings settings;
  settings.least_saving = 1.01 * saving;
  EXPECT_EQ(search(settings).choose(coarse, seen, false).clock_hz, top_hz);
  settings.least_saving = 0.99 * saving;
  EXPECT_EQ(search(settings).choose(coarse, seen, false), search().choose(coarse, seen, false));
  EXPECT_LT(search().choose(coarse, seen, false).clock_hz, top_hz);
}

TEST(ClockSearch, its_speed_is_that_of_equation_2_for_its_response) {
  const ClockSearch one = search();
  const Surroundings around = surroundings_of(in_the_open(20.0));
  const EnergyEstimate told = one.estimate({0.80, 12.0, top_hz}, around);
  EXPECT_DOUBLE_EQ(told.response_s, response_s({}, one.latency().predicted_s(told.setting)));
  EXPECT_DOUBLE_EQ(told.speed_m_s,
                   safe_speed(6.0, told.response_s, free_ahead_m(told.setting, 30.0)));
  EXPECT_GT(told.watts_per_second, 0.0);
  EXPECT_EQ(one.estimate({0.80, 12.0, top_hz}, surroundings_of(in_the_open(1.0))).watts_per_second,
            0.0)
      << "at the mission's own limit";
}

TEST(ClockSearch, brakes_as_the_mission_does) {
  Observation seen = in_the_open(20.0);
  const ClockSearch one = search();
  const double usual_m_s = one.estimate({0.80, 12.0, top_hz}, surroundings_of(seen)).speed_m_s;
  seen.max_deceleration_m_s2 = 2.0;
  EXPECT_LT(one.estimate({0.80, 12.0, top_hz}, surroundings_of(seen)).speed_m_s, usual_m_s);
}

TEST(ClockSearch, compares_by_the_predicted_latency_and_not_by_its_bound) {
  ClockSearchSettings wide;
  wide.latency.bound.first = std::log(4.0);
  const Surroundings around = surroundings_of(in_the_open(20.0));
  const MapSetting setting{0.80, 12.0, top_hz};
  EXPECT_EQ(search(wide).estimate(setting, around).joules_per_m,
            search().estimate(setting, around).joules_per_m);
}

TEST(ClockSearch, options_are_what_is_allowed_the_cheapest_first) {
  ClockSearch one = search();
  (void)one.choose(coarse, in_the_open(1.0), false);
  const auto options = options_of(one.weighed());
  ASSERT_EQ(options.size(), 5U);
  for (std::size_t i = 1; i < options.size(); ++i) {
    EXPECT_LE(options[i - 1].joules_per_m, options[i].joules_per_m);
  }
  (void)one.choose(coarse, in_the_open(1.0), true);
  EXPECT_EQ(options_of(one.weighed()).size(), 1U) << "the top one only";
}

TEST(ClockSearch, refuses_a_computer_without_clocks) {
  const std::vector<LatencyLevel> levels{{0.15, 0.5, 2.2}};
  EXPECT_FALSE(ClockSearch::make({}, levels, {}, *conformance_board().power).ok());
}

TEST(ClockSearch, refuses_what_has_no_logarithm) {
  const auto refusal = [](double first_range_m, double least_hz, double cells_m) {
    KnobSettings knobs = kit::search_knobs({least_hz, top_hz});
    std::vector<KnobSpec> specs = knobs.specs();
    for (KnobSpec& spec : specs) {
      if (spec.name == "map.range_m") {
        spec.min = spec.fallback = first_range_m;
      }
    }
    const auto made = ClockSearch::make({}, {{cells_m, 0.4, 2.2}}, KnobSettings{specs},
                                        *conformance_board().power);
    return made ? std::string{} : made.error().message;
  };
  EXPECT_EQ(refusal(7.0, 1e9, 0.15), "");
  EXPECT_EQ(refusal(0.0, 1e9, 0.15),
            "knob map.range_m begins at 0 m; give it a start value above 0");
  for (const double hz : {0.0, 1e-300}) {
    EXPECT_NE(refusal(7.0, hz, 0.15).find(" Hz; every clock must be from 1e6 to 1e12 Hz"),
              std::string::npos)
        << hz;
  }
  EXPECT_EQ(refusal(7.0, 1e9, 0.0),
            "knob map.resolution_m may be 0 m; every size of cells must be above 0");
}

TEST(ClockSearchAtRest, takes_the_lowest_clock_that_is_soon_enough) {
  // t ~ .9 / f + .05 and the first bound is e^.4 times what is expected: .60 s at the top, .78 s at
  // 1.5 GHz, 1.13 s at 1 GHz, 2.21 s at .5 GHz; of the coarse map at 7 m 1.09 s at .25 GHz.
  ClockSearch one = search();
  EXPECT_EQ(one.rest(fine, 1.2, {}).clock_hz, 1e9);
  EXPECT_EQ(one.rest(fine, 2.3, {}).clock_hz, 0.5e9);
  EXPECT_EQ(one.rest({0.80, 7.0, 0.0}, 1.2, {}).clock_hz, 0.25e9);
}

TEST(ClockSearchAtRest, takes_the_highest_clock_where_none_is_soon_enough) {
  EXPECT_EQ(search().rest(fine, 0.1, {}).clock_hz, top_hz);
}

TEST(ClockSearchAtRest, takes_the_lowest_clock_of_all_where_no_map_is_made) {
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(search().rest(fine, never, {}).clock_hz, 0.25e9);
}

TEST(ClockSearchAtRest, goes_up_by_a_clock_for_each_deadline_that_it_has_missed) {
  ClockSearch one = search();
  Observation waits = in_the_open(1.0);
  waits.phase = MissionPhase::wait;
  const auto clock_hz = [&] {
    waits.now += std::chrono::seconds{1};
    return one.rest(fine, one.idle_map_s(waits).value_or(0.0), waits.now).clock_hz;
  };
  (void)one.idle_map_s(waits);  // It waits for a second before it rests.
  EXPECT_EQ(clock_hz(), 1.5e9);
  waits.deadline_misses = 1;
  EXPECT_EQ(clock_hz(), top_hz);
  EXPECT_EQ(clock_hz(), top_hz) << "there is no higher one";
}

TEST(ClockSearchAtRest, is_in_force_and_weighs_no_joules_per_metre) {
  ClockSearch one = search();
  const MapSetting rest = one.rest(fine, 1.0, {});
  EXPECT_EQ(one.in_force(), rest);
  EXPECT_TRUE(options_of(one.weighed()).empty());
}

}  // namespace
}  // namespace flyball
