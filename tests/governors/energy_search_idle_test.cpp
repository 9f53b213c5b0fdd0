// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone

#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy_conformance.h"

#include "search_knobs.h"
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double top_hz = 2e9;

EnergySearch search() {
  const std::vector<SearchLevel> levels{{0.15, 0.4, 2.2, 25.0, 7.0, top_hz},
                                        {0.80, 0.1, 1.0, 25.0, 7.0, top_hz}};
  return *EnergySearch::make({}, levels, {7.0, 12.0},
                             kit::search_knobs({0.25e9, 0.5e9, 1e9, 1.5e9, top_hz}),
                             *conformance_board().power);
}

TEST(EnergySearchIdle, takes_the_lowest_clock_that_is_soon_enough) {
  // t ~ .9 / f + .05 and the first bound is e^.4 times what is expected: .60 s at the top, .78 s at
  // 1.5 GHz, 1.13 s at 1 GHz, 2.21 s at .5 GHz; of the coarse map 1.09 s at .25 GHz.
  EnergySearch one = search();
  EXPECT_EQ(one.idle(0.15, 7.0, 1.2, 0, {}).clock_hz, 1e9);
  EXPECT_EQ(one.idle(0.15, 7.0, 2.3, 0, {}).clock_hz, 0.5e9);
  EXPECT_EQ(one.idle(0.80, 7.0, 1.2, 0, {}).clock_hz, 0.25e9);
}

TEST(EnergySearchIdle, takes_the_highest_clock_where_none_is_soon_enough) {
  EXPECT_EQ(search().idle(0.15, 7.0, 0.1, 0, {}).clock_hz, top_hz);
}

TEST(EnergySearchIdle, takes_the_lowest_clock_of_all_where_no_map_is_made) {
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(search().idle(0.15, 7.0, never, 0, {}).clock_hz, 0.25e9);
}

TEST(EnergySearchIdle, is_raised_by_as_many_clocks_as_there_are_at_most) {
  EnergySearch one = search();
  EXPECT_EQ(one.idle(0.15, 7.0, 1.2, 1, {}).clock_hz, 1.5e9);
  EXPECT_EQ(one.idle(0.15, 7.0, 1.0, 9, {}).clock_hz, top_hz);
}

TEST(EnergySearchIdle, is_in_force_and_weighs_no_joules_per_metre) {
  EnergySearch one = search();
  const MapSetting idle = one.idle(0.15, 7.0, 1.0, 0, {});
  EXPECT_EQ(one.in_force(), idle);
  for (const EnergyEstimate& weighed : one.weighed()) {
    EXPECT_TRUE(std::isinf(weighed.joules_per_m));
  }
}

TEST(EnergySearchIdle, somebody_elses_cells_are_kept) {
  EnergySearch one = search();
  Surroundings around;
  around.speed_limit_m_s = 10.0;
  around.visibility_m = 1e9;
  around.coarsest_m = around.finest_m = 0.15;
  EXPECT_EQ(one.choose(around, {}).setting.resolution_m, 0.15);
  around.coarsest_m = around.finest_m = 0.80;
  EXPECT_EQ(one.choose(around, {}).setting.resolution_m, 0.80);
}

}  // namespace
}  // namespace flyball
