// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "counting_new.h"
#include "cruising.h"
#include "policy_start.h"
#include "started_policy.h"

#include <gtest/gtest.h>

namespace {

using namespace std::chrono_literals;
using flyball::kit::cruising;
using flyball::kit::top_hz;
using flyball::kit::wish_for;

/// Frames take what cells and range ask for, as 1 / f, wherever they are taken.
flyball::Foresight told(const flyball::Policy& policy, double finest_s, double gap_at_m) {
  flyball::Foresight truth;
  for (int i = 0; i < 16; ++i) {
    const double ahead_m = 4.0 * i;
    const bool is_gap = std::abs(ahead_m - gap_at_m) < 2.0;
    truth.places.push_back({ahead_m, 6.0, is_gap ? 0.9 : 24.0, is_gap ? 0.45 : 20.0});
    for (const flyball::MapSetting& one :
         dynamic_cast<const flyball::UsesForesight&>(policy).foresees()) {
      const double range = one.range_m / 12.0;
      truth.frame_s.push_back(finest_s * range * range * 0.15 / one.resolution_m * top_hz /
                              one.clock_hz);
    }
  }
  return truth;
}

struct Rule {
  Rule() : started{flyball::start_policy("reference", {})} {}
  flyball::Decision decide(const flyball::Observation& seen, const flyball::Foresight& truth) {
    dynamic_cast<flyball::UsesForesight&>(*started.policy).foretell(truth);
    return started.policy->decide(seen);
  }
  flyball::StartedPolicy started;
};

TEST(Reference, asks_for_the_durations_of_all_that_it_may_choose) {
  const Rule rule;
  ASSERT_TRUE(rule.started.status.ok());
  const auto asked = dynamic_cast<const flyball::UsesForesight&>(*rule.started.policy).foresees();
  EXPECT_GT(asked.size(), 50U);
  const auto blind = flyball::start_policy("mission_energy", {});
  EXPECT_EQ(dynamic_cast<const flyball::UsesForesight*>(blind.policy.get()), nullptr);
}

TEST(Reference, flies_the_open_at_a_lower_clock_where_frames_are_soon_enough) {
  Rule rule;
  const flyball::Foresight quick = told(*rule.started.policy, 0.05, 1000.0);
  EXPECT_LT(wish_for(rule.decide(cruising(), quick), "cpu.frequency_hz"), top_hz);
  const flyball::Foresight late = told(*rule.started.policy, 5.0, 1000.0);
  EXPECT_EQ(wish_for(rule.decide(cruising(), late), "cpu.frequency_hz"), top_hz);
}

// It is told that finest cells take long; the gap is nearer than they must show it.
TEST(Reference, refines_before_a_gap_that_the_map_shows) {
  Rule rule;
  flyball::Observation seen = cruising();
  seen.map_resolution_m = 0.15;
  const auto cells_m = [&](double gap_at_m) {
    seen.now += 250ms;
    ++seen.map_revision;
    return wish_for(rule.decide(seen, told(*rule.started.policy, 1.0, gap_at_m)),
                    "map.resolution_m");
  };
  EXPECT_GT(cells_m(40.0), 0.15);
  seen.narrowest_gap_m = 0.9;
  seen.gap_distance_m = 4.0;
  EXPECT_EQ(cells_m(4.0), 0.15);
}

TEST(Reference, untold_decides_as_mission_energy_does) {
  const Rule rule;
  const auto other = flyball::start_policy("mission_energy", {});
  for (const flyball::Observation& seen : flyball::plausible_observations(200)) {
    const flyball::Decision mine = rule.started.policy->decide(seen);
    const flyball::Decision its = other.policy->decide(seen);
    for (const char* knob : {"map.resolution_m", "map.range_m", "cpu.frequency_hz"}) {
      ASSERT_EQ(wish_for(mine, knob), wish_for(its, knob)) << knob;
    }
  }
}

TEST(Reference, told_or_not_it_allocates_nothing_and_decides_the_same_again) {
  Rule one;
  Rule other;
  const flyball::Foresight truth = told(*one.started.policy, 0.3, 24.0);
  const auto seen = flyball::plausible_observations(100);
  std::vector<flyball::Decision> mine(seen.size());
  const std::size_t before = flyball::allocation_count();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    mine[i] = one.decide(seen[i], truth);
  }
  EXPECT_EQ(flyball::allocation_count(), before);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const flyball::Decision its = other.decide(seen[i], truth);
    ASSERT_EQ(wish_for(mine[i], "map.range_m"), wish_for(its, "map.range_m"));
    ASSERT_EQ(wish_for(mine[i], "map.resolution_m"), wish_for(its, "map.resolution_m"));
  }
}

TEST(Reference, refuses_levels_that_are_no_levels) {
  const auto started = flyball::start_policy("reference", {{"fine_m", 0.80}, {"coarse_m", 0.15}});
  ASSERT_FALSE(started.status.ok());
  EXPECT_NE(started.status.error().message.find("reference"), std::string::npos);
}

}  // namespace
