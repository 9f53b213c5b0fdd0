// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/hindsight.h"

#include "made_flights.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

KnobSettings knobs(std::vector<double> cells_m = {}) {
  KnobSpec cells{"map.resolution_m", "m", "map", std::move(cells_m), 0.05, 2.0, 0.15, "cells"};
  if (!cells.legal.empty()) {
    cells.min = cells.legal.front();
    cells.max = cells.legal.back();
    cells.fallback = cells.nearest(cells.fallback);
  }
  return KnobSettings{{cells,
                       {"map.range_m", "m", "points", {}, 2.0, 25.0, 7.0, "range"},
                       {"planner.budget", "iterations", "plan", {}, 100.0, 1e6, 4000.0, "budget"}}};
}

Candidate setting(double resolution_m, double range_m, double budget) {
  return {{{"resolution_m", resolution_m}, {"range_m", range_m}, {"planner_budget", budget}}, {}};
}

Candidate flown(std::initializer_list<double> energies_j) {
  Candidate candidate;
  for (const double energy_j : energies_j) {
    candidate.flights.push_back(made_summary("a", candidate.flights.size()));
    candidate.flights.back().energy_rotor_j = energy_j;
    candidate.flights.back().energy_computer_j = 0.0;
    candidate.flights.back().policy_faults = 0;
    if (energy_j == 0.0) {
      candidate.flights.back().status = MissionStatus::failed;
    }
  }
  return candidate;
}

TEST(Hindsight, begins_with_two_dozen_settings_and_more_on_any_mapper) {
  for (const auto& cells : {std::vector<double>{}, {0.15, 0.3, 0.6, 1.2}, {0.1, 0.2, 0.4}}) {
    const auto grid = hindsight_grid(knobs(cells));
    ASSERT_TRUE(grid);
    EXPECT_GE(settings_of(*grid).size(), 24U);
    for (const GridAxis& axis : *grid) {
      for (const double value : axis.values) {
        EXPECT_TRUE(axis.knob.is_legal(value)) << axis.parameter << " " << value;
      }
    }
  }
}

TEST(Hindsight, says_which_knob_is_missing) {
  const auto grid = hindsight_grid(
      KnobSettings{{{"map.resolution_m", "m", "map", {}, 0.05, 2.0, 0.15, "cells"}}});
  ASSERT_FALSE(grid);
  EXPECT_NE(grid.error().message.find("map.range_m"), std::string::npos);
}

TEST(Hindsight, goes_beyond_the_grid_as_far_as_the_knob_does) {
  const GridAxis free = (*hindsight_grid(knobs()))[0];
  EXPECT_EQ(free.next(0.3, false), 0.15);
  EXPECT_DOUBLE_EQ(*free.next(0.15, false), 0.075);
  EXPECT_DOUBLE_EQ(*free.next(0.075, false), 0.05);
  EXPECT_FALSE(free.next(0.05, false));
  const GridAxis listed = (*hindsight_grid(knobs({0.075, 0.15, 0.3})))[0];
  EXPECT_EQ(listed.next(0.15, false), 0.075) << "the mapper's own cells go on";
  EXPECT_FALSE(listed.next(0.3, true));
}

TEST(Hindsight, knows_the_neighbours_of_a_setting) {
  const auto grid = hindsight_grid(knobs());
  EXPECT_EQ(neighbours_of(*grid, setting(0.3, 10.0, 4000.0)).size(), 6U);
  const auto at_border = neighbours_of(*grid, setting(0.3, 25.0, 4000.0));
  EXPECT_EQ(at_border.size(), 5U) << "no range is longer";
}

TEST(Hindsight, success_comes_before_the_median_of_energy) {
  EXPECT_TRUE(is_better_in_hindsight(flown({9e3, 9e3}), flown({1e3, 0.0})));
  EXPECT_TRUE(is_better_in_hindsight(flown({1e3, 2e3, 9e3}), flown({3e3, 3e3, 3e3})));
  EXPECT_FALSE(is_better_in_hindsight(flown({2e3}), flown({2e3})));
}

TEST(Hindsight, drops_what_cannot_become_the_best) {
  const Candidate best = flown({1e3, 0.0, 1e3, 1e3});
  EXPECT_FALSE(has_lost(flown({0.0}), best)) << "the best has failed once, too";
  EXPECT_TRUE(has_lost(flown({0.0, 0.0}), best));
  EXPECT_FALSE(has_lost(flown({2e3}), best)) << "one seed says little";
  EXPECT_TRUE(has_lost(flown({2e3, 2e3, 2e3}), flown({1e3, 1e3, 1e3, 1e3})));
  EXPECT_FALSE(has_lost(flown({2e3, 1.05e3, 2e3}), flown({1e3, 1e3, 1e3, 1e3})));
}

TEST(Hindsight, says_when_the_best_lies_on_a_border) {
  const auto grid = hindsight_grid(knobs());
  Candidate best = setting(0.15, 25.0, 1000.0);
  best.flights = flown({1e3}).flights;
  std::vector<Candidate> all{best};
  for (Candidate other : neighbours_of(*grid, best)) {
    if (other.parameters["planner_budget"] >= 1000.0) {
      other.flights = flown({2e3}).flights;
    }
    all.push_back(std::move(other));
  }
  const Hindsight told = told_in_hindsight(*grid, best, all);
  EXPECT_EQ(told.setting, "planner_budget=1000 range_m=25 resolution_m=0.15");
  EXPECT_EQ(told.tried, 5U);
  ASSERT_EQ(told.borders.size(), 2U) << told.text();
  EXPECT_NE(told.borders[0].find("range_m is the highest that map.range_m has"), std::string::npos);
  EXPECT_NE(told.borders[1].find("planner_budget is the lowest that was flown"), std::string::npos);
}

}  // namespace
}  // namespace flyball
