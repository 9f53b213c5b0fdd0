// SPDX-License-Identifier: BSD-3-Clause
// What the rule does on a mapper with a lattice of cells; the instruments have tests of their own.
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/surroundings.h"

#include "cruising.h"
#include "started_policy.h"
#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace {

using namespace std::chrono_literals;

using flyball::kit::cruising;
using flyball::kit::top_hz;

flyball::Observation near_a_door() {
  flyball::Observation seen = cruising();
  seen.narrowest_gap_m = 0.8;
  seen.gap_distance_m = seen.nearest_obstacle_m = 4.0;
  seen.obstacle_density = 0.1;
  return seen;
}

double rule_wished(const flyball::Decision& decision, const std::string& knob) {
  for (const auto& wish : decision) {
    if (knob == wish.knob) {
      return wish.value;
    }
  }
  ADD_FAILURE() << "no wish for " << knob;
  return 0.0;
}

struct EnergyRule {
  explicit EnergyRule(const std::map<std::string, flyball::ParameterValue>& given = {})
      : started{flyball::start_policy("mission_energy", given)} {}
  double wish(const flyball::Observation& seen, const std::string& knob) {
    return rule_wished(started.policy->decide(seen), knob);
  }
  flyball::StartedPolicy started;
};

TEST(MissionEnergy, has_finest_cells_at_the_top_clock_before_a_door) {
  EnergyRule rule;
  EXPECT_EQ(rule.wish(near_a_door(), "map.resolution_m"), 0.15);
  EXPECT_EQ(rule.wish(near_a_door(), "cpu.frequency_hz"), top_hz);
}

TEST(MissionEnergy, has_no_large_cells_where_the_mission_is_slow) {
  flyball::Observation seen = cruising();
  seen.speed_limit_m_s = 1.0;
  EXPECT_LE(EnergyRule{}.wish(seen, "map.resolution_m"), 0.355);
}

/// A small vehicle, whose computer's watts count, flies on like this for half a minute.
double clock_hz(double speed_m_s, double gap_m) {
  flyball::Observation seen = cruising();
  seen.speed_limit_m_s = 3.0;
  seen.speed_m_s = speed_m_s;
  seen.rotor_power = flyball::Watts{20.0};
  seen.narrowest_gap_m = gap_m;
  EnergyRule rule;
  for (int i = 0; i < 120; ++i) {
    seen.now += 250ms;
    ++seen.map_revision;
    (void)rule.started.policy->decide(seen);
  }
  return rule.wish(seen, "cpu.frequency_hz");
}

TEST(MissionEnergy, keeps_the_top_clock_while_a_gap_ahead_holds_it_up) {
  constexpr double gap_m = 4.0;
  EXPECT_EQ(clock_hz(2.0, gap_m), top_hz);
  EXPECT_LT(clock_hz(3.0, gap_m), top_hz);
  EXPECT_LT(clock_hz(2.0, flyball::open_path_m), top_hz);
}

flyball::BoardModel board_of_a_vehicle_that_brakes_after(flyball::Duration reaction) {
  flyball::BoardModel board = flyball::conformance_board();
  board.vehicle.reaction_time = reaction;
  return board;
}

/// What the rule expects of each setting in the open, where the mission would let it fly at 9 m/s.
std::map<std::string, flyball::PolicyOption> expected(flyball::Duration reaction) {
  const flyball::StartedPolicy started =
      flyball::start_policy("mission_energy", {}, flyball::conformance_knobs(),
                            board_of_a_vehicle_that_brakes_after(reaction));
  flyball::Observation seen = cruising();
  seen.speed_limit_m_s = 9.0;
  (void)started.policy->decide(seen);
  std::map<std::string, flyball::PolicyOption> all;
  for (const flyball::PolicyOption& option :
       dynamic_cast<const flyball::ComparesOptions&>(*started.policy).options()) {
    std::string name;
    for (const auto& [knob, value] : option.setting) {
      name += std::string{knob} + "=" + std::to_string(value) + " ";
    }
    all[name] = option;
  }
  return all;
}

TEST(MissionEnergy, expects_less_speed_of_each_setting_where_the_vehicle_brakes_late) {
  const auto usual = expected(140ms);
  const auto late = expected(640ms);
  ASSERT_EQ(usual.size(), late.size());
  ASSERT_EQ(usual.size(), 3U) << "clocks";
  for (const auto& [setting, option] : usual) {
    EXPECT_NEAR(late.at(setting).response_s, option.response_s + 0.5, 1e-9) << setting;
    EXPECT_LT(late.at(setting).speed_m_s, option.speed_m_s) << setting;
  }
}

bool has_wish(const flyball::Decision& decision, const std::string& knob) {
  return std::any_of(decision.begin(), decision.end(),
                     [&knob](const auto& wish) { return knob == wish.knob; });
}

/// An office, of which some has been mapped.
flyball::Observation exploring() {
  flyball::Observation seen = cruising();
  seen.progress_unit = flyball::ProgressUnit::cubic_metre;
  return seen;
}

/// The last decision of a mission of twenty views, for each of which so long was searched.
flyball::Decision after_searches(flyball::Duration search, double half_view_nodes = 1.0) {
  constexpr int views = 20;
  constexpr int decisions_per_view = 32;  // Eight seconds.
  const auto started =
      flyball::start_policy("mission_energy", {{"half_view_nodes", half_view_nodes}});
  flyball::Observation seen = exploring();
  flyball::Decision decision;
  for (int i = 0; i < views * decisions_per_view; ++i) {
    seen.now += 250ms;
    flyball::StageUse& explore = seen.stage(flyball::Stage::explore);
    const bool is_over = search > 0ms && i % decisions_per_view == 0;
    explore.latency = search;
    explore.load = is_over ? 1.0 : 0.0;
    decision = started.policy->decide(seen);
  }
  return decision;
}

TEST(MissionEnergy, looks_for_a_view_for_as_long_as_that_shows_the_most_a_second) {
  const double quick = rule_wished(after_searches(1s), "explore.iterations");
  const double slow = rule_wished(after_searches(4s), "explore.iterations");
  EXPECT_GT(quick, slow);
  EXPECT_GE(slow, 1.0);
}

TEST(MissionEnergy, looks_for_the_first_view_for_less_long_than_explorers_do) {
  constexpr double explorers_nodes = 15.0;  // Unless a policy sets it (MAVBench).
  EXPECT_LT(EnergyRule{}.wish(exploring(), "explore.iterations"), explorers_nodes);
}

TEST(MissionEnergy, looks_for_views_with_all_cores_that_are_granted) {
  flyball::Observation seen = exploring();
  for (const int cores : {4, 2}) {
    seen.cores = cores;
    EXPECT_EQ(EnergyRule{}.wish(seen, "explore.threads"), cores);
    EXPECT_EQ(EnergyRule({{"view_threads", 1.0}}).wish(seen, "explore.threads"), 1.0) << "as set";
  }
  seen.cores = 0;
  EXPECT_FALSE(has_wish(EnergyRule{}.started.policy->decide(seen), "explore.threads"))
      << "nobody says how many there are";
}

TEST(MissionEnergy, leaves_the_search_for_views_alone_where_there_is_none_or_it_shall) {
  for (const char* knob : {"explore.iterations", "explore.threads"}) {
    EXPECT_FALSE(has_wish(EnergyRule{}.started.policy->decide(cruising()), knob)) << knob;
  }
  EXPECT_FALSE(has_wish(after_searches(1s, 0.0), "explore.iterations")) << "as set";
}

TEST(MissionEnergy, has_smaller_cells_for_a_while_after_a_plan_has_failed_in_large_ones) {
  flyball::Observation seen = cruising();
  seen.speed_m_s = 4.0;
  EnergyRule rule;
  const auto resolution_m = [&] {
    seen.now += 250ms;
    ++seen.map_revision;
    seen.map_resolution_m = rule.wish(seen, "map.resolution_m");
    return seen.map_resolution_m;
  };
  EXPECT_EQ(resolution_m(), 0.6);
  seen.planner_failures = 1;
  EXPECT_LE(resolution_m(), 0.355);
  seen.planner_failures = 0;
  EXPECT_LE(resolution_m(), 0.355) << "two seconds at least";
  for (int i = 0; i < 20; ++i) {
    (void)resolution_m();
  }
  EXPECT_EQ(resolution_m(), 0.6);
}

// A plan that is being made in fine cells must still be true in the map when it comes.
TEST(MissionEnergy, has_no_larger_cells_than_before_while_it_stands_and_waits_for_a_plan) {
  flyball::Observation seen = near_a_door();
  EnergyRule rule;
  ASSERT_EQ(rule.wish(seen, "map.resolution_m"), 0.15);
  const flyball::MissionTime at_door = seen.now;
  seen = cruising();
  seen.map_resolution_m = 0.15;
  seen.speed_m_s = 0.05;
  seen.now = at_door + 600s;  // Long past the door and what else holds finer cells.
  EXPECT_EQ(rule.wish(seen, "map.resolution_m"), 0.15);
  seen.speed_m_s = 6.0;
  for (int i = 0; i < 40; ++i) {
    seen.now += 250ms;
    ++seen.map_revision;
    seen.map_resolution_m = rule.wish(seen, "map.resolution_m");
  }
  EXPECT_GT(seen.map_resolution_m, 0.15);
}

TEST(MissionEnergy, plans_on_the_ground_in_the_cells_that_it_will_fly_with) {
  const double in_flight_m = EnergyRule{}.wish(cruising(), "map.resolution_m");
  for (const auto phase : {flyball::MissionPhase::take_off, flyball::MissionPhase::land}) {
    flyball::Observation seen = cruising();
    seen.phase = phase;
    seen.speed_m_s = 0.0;
    EXPECT_EQ(EnergyRule{}.wish(seen, "map.resolution_m"), in_flight_m);
  }
}

}  // namespace
