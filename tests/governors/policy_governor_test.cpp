// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/governors/policy_governor.h"

#include "rule_policy.h"
#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace {

using flyball::Decision;
using flyball::MissionTime;
using flyball::Observation;
using flyball::PolicyFault;
using flyball::kit::Rule;
using flyball::kit::RulePolicy;
using namespace std::chrono_literals;

flyball::KnobSettings knobs() {
  flyball::KnobSettings settings = flyball::kit::map_knobs();
  EXPECT_TRUE(settings.set("map.resolution_m", 0.80).ok());
  return settings;
}

flyball::PolicyGovernor governor_of(Rule rule,
                                    flyball::PolicyGovernorSettings settings = {},
                                    flyball::PolicyGovernor::HostClock clock = {}) {
  return {std::make_unique<RulePolicy>(std::move(rule)), knobs(), settings, std::move(clock)};
}

Decision wish(std::string_view knob, double value) {
  Decision decision;
  decision.reason = flyball::Reason::energy;
  decision.set(knob, value);
  return decision;
}

Observation at(std::chrono::milliseconds t) {
  Observation seen;
  seen.phase = flyball::MissionPhase::cruise;
  seen.now = MissionTime{t};
  return seen;
}

std::map<std::string, double> values(const Decision& decision) {
  std::map<std::string, double> all;
  for (const auto& [knob, value] : decision) {
    all[std::string{knob}] = value;
  }
  return all;
}

const std::map<std::string, double> safe_default{{"map.resolution_m", 0.15}, {"map.range_m", 7.0}};

TEST(PolicyGovernor, moves_a_wish_to_the_nearest_legal_value) {
  double wished = 0.0;
  auto governor = governor_of([&](const Observation&) { return wish("map.resolution_m", wished); },
                              {0ms, 100ms, 3});
  for (const auto& [asked, given] : std::map<double, double>{
           {-1e300, 0.15}, {0.16, 0.15}, {0.29, 0.30}, {0.56, 0.80}, {1e300, 0.80}}) {
    wished = asked;
    const auto decision = governor.decide(at(0ms));
    EXPECT_EQ(given, values(decision).at("map.resolution_m")) << asked;
    EXPECT_EQ(flyball::Reason::energy, decision.reason);
    EXPECT_EQ(PolicyFault::none, governor.last_fault());
  }
}

TEST(PolicyGovernor, clamps_a_continuous_knob_to_its_range) {
  auto governor = governor_of([](const Observation&) { return wish("map.range_m", 25.0); });
  EXPECT_EQ(10.0, values(governor.decide(at(0ms))).at("map.range_m"));
}

TEST(PolicyGovernor, leaves_knobs_alone_that_the_policy_does_not_name) {
  auto governor = governor_of([](const Observation&) { return wish("map.range_m", 5.0); });
  EXPECT_EQ(1U, governor.decide(at(0ms)).size());
}

TEST(PolicyGovernor, changes_a_knob_no_sooner_than_the_dwell_allows) {
  double wished = 0.15;
  auto governor = governor_of([&](const Observation&) { return wish("map.resolution_m", wished); },
                              {500ms, 100ms, 3});
  EXPECT_EQ(0.15, values(governor.decide(at(0ms))).at("map.resolution_m"));
  wished = 0.80;
  EXPECT_EQ(0.15, values(governor.decide(at(250ms))).at("map.resolution_m"));
  EXPECT_EQ(0.15, values(governor.decide(at(499ms))).at("map.resolution_m"));
  EXPECT_EQ(0.80, values(governor.decide(at(500ms))).at("map.resolution_m"));
}

TEST(PolicyGovernor, counts_the_dwell_from_changes_and_not_from_repetitions) {
  double wished = 0.15;
  auto governor = governor_of([&](const Observation&) { return wish("map.resolution_m", wished); },
                              {500ms, 100ms, 3});
  for (const auto t : {0ms, 250ms, 500ms}) {
    EXPECT_EQ(0.15, values(governor.decide(at(t))).at("map.resolution_m"));
  }
  wished = 0.80;
  EXPECT_EQ(0.80, values(governor.decide(at(501ms))).at("map.resolution_m"));
}

TEST(PolicyGovernor, lets_each_knob_dwell_by_itself) {
  auto governor = governor_of(
      [](const Observation& seen) {
        return seen.now < MissionTime{100ms} ? wish("map.resolution_m", 0.15)
                                             : wish("map.range_m", 4.0);
      },
      {500ms, 100ms, 3});
  static_cast<void>(governor.decide(at(0ms)));
  EXPECT_EQ(4.0, values(governor.decide(at(100ms))).at("map.range_m"));
}

TEST(PolicyGovernor, lets_a_knob_say_how_long_it_dwells) {
  flyball::KnobSpec clock;
  clock.name = "cpu.frequency_hz";
  clock.legal = {1e9, 2e9};
  clock.fallback = 2e9;
  clock.min_dwell = 2ms;
  flyball::PolicyGovernor governor{std::make_unique<RulePolicy>([](const Observation& seen) {
                                     return wish("cpu.frequency_hz",
                                                 seen.now < MissionTime{1ms} ? 1e9 : 2e9);
                                   }),
                                   flyball::KnobSettings{{clock}},
                                   {500ms, 100ms, 3},
                                   {}};
  EXPECT_EQ(1e9, values(governor.decide(at(0ms))).at("cpu.frequency_hz"));
  EXPECT_EQ(1e9, values(governor.decide(at(1ms))).at("cpu.frequency_hz"));
  EXPECT_EQ(2e9, values(governor.decide(at(2ms))).at("cpu.frequency_hz"));
}

// A range for large cells takes seconds in small ones.
TEST(PolicyGovernor, changes_a_knob_together_with_the_one_that_it_follows) {
  flyball::KnobSpec range;
  range.name = "map.range_m";
  range.min = 2.0;
  range.max = 25.0;
  range.fallback = 7.0;
  range.follows = "map.resolution_m";
  flyball::KnobSpec cells;
  cells.name = "map.resolution_m";
  cells.legal = {0.15, 1.2};
  cells.fallback = 0.15;
  using Setting = std::pair<double, double>;  // Range and cells.
  const Setting fine{7.0, 0.15};
  const Setting coarse{20.0, 1.2};
  const Setting longer{22.0, 1.2};
  Setting wished = coarse;
  flyball::PolicyGovernor governor{std::make_unique<RulePolicy>([&wished](const Observation&) {
                                     Decision decision = wish("map.range_m", wished.first);
                                     decision.set("map.resolution_m", wished.second);
                                     return decision;
                                   }),
                                   flyball::KnobSettings{{range, cells}},
                                   {500ms, 100ms, 3},
                                   {}};
  const auto answer = [&governor](std::chrono::milliseconds now) {
    const auto given = values(governor.decide(at(now)));
    return Setting{given.at("map.range_m"), given.at("map.resolution_m")};
  };
  EXPECT_EQ(coarse, answer(0ms));
  wished = fine;
  EXPECT_EQ(coarse, answer(250ms)) << "the cells have to wait, and the range with them";
  wished = longer;
  EXPECT_EQ(longer, answer(500ms));
  wished = fine;
  EXPECT_EQ(fine, answer(600ms)) << "the cells may change, and the range with them";
  wished.first = 5.0;
  EXPECT_EQ(fine, answer(700ms)) << "alone it dwells as any knob";
}

struct Fault {
  Rule rule;
  PolicyFault name;
};

std::vector<Fault> faulty_rules() {
  const auto both = [](std::string_view knob, double value) {
    return [knob, value](const Observation&) {
      Decision decision = wish("map.range_m", 3.0);
      decision.set(knob, value);
      return decision;
    };
  };
  const double infinity = std::numeric_limits<double>::infinity();
  return {{both("map.resolution_m", std::nan("")), PolicyFault::not_finite},
          {both("map.resolution_m", infinity), PolicyFault::not_finite},
          {both("map.resolution_m", -infinity), PolicyFault::not_finite},
          {both("map.colour", 1.0), PolicyFault::unknown_knob},
          {both("", 1.0), PolicyFault::unknown_knob},
          {[](const Observation&) {
             Decision decision;
             for (std::size_t i = 0; i <= Decision::capacity; ++i) {
               decision.set("map.range_m", 3.0);
             }
             return decision;
           },
           PolicyFault::overflow}};
}

TEST(PolicyGovernor, replaces_a_faulty_answer_as_a_whole_by_the_defaults) {
  for (const Fault& fault : faulty_rules()) {
    auto governor = governor_of(fault.rule);
    const auto decision = governor.decide(at(0ms));
    EXPECT_EQ(safe_default, values(decision));
    EXPECT_EQ(flyball::Reason::fallback, decision.reason);
    EXPECT_EQ(fault.name, governor.last_fault()) << to_string(fault.name);
  }
}

TEST(PolicyGovernor, falls_back_for_good_after_three_faults_in_a_row) {
  int asked = 0;
  auto governor = governor_of([&](const Observation&) {
    ++asked;
    return asked <= 3 ? wish("map.colour", 1.0) : wish("map.range_m", 3.0);
  });
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(i >= 3, governor.has_fallen_back());
    EXPECT_EQ(safe_default, values(governor.decide(at(i * 1000ms))));
  }
  EXPECT_EQ(3, asked);
  EXPECT_EQ(PolicyFault::unknown_knob, governor.last_fault());
}

TEST(PolicyGovernor, forgives_faults_that_are_not_in_a_row) {
  int asked = 0;
  auto governor = governor_of([&](const Observation&) {
    return ++asked % 3 == 0 ? wish("map.range_m", 3.0) : wish("map.colour", 1.0);
  });
  for (int i = 0; i < 30; ++i) {
    static_cast<void>(governor.decide(at(i * 1000ms)));
  }
  EXPECT_EQ(30, asked);
  EXPECT_FALSE(governor.has_fallen_back());
  EXPECT_EQ(PolicyFault::none, governor.last_fault());
}

TEST(PolicyGovernor, goes_to_the_safe_default_without_waiting_for_the_dwell) {
  int asked = 0;
  auto governor = governor_of([&](const Observation&) {
    return ++asked == 1 ? wish("map.range_m", 3.0) : wish("map.range_m", std::nan(""));
  });
  static_cast<void>(governor.decide(at(0ms)));
  EXPECT_EQ(7.0, values(governor.decide(at(1ms))).at("map.range_m"));
}

TEST(PolicyGovernor, replaces_an_answer_that_took_too_long) {
  flyball::HostTime host{};
  std::chrono::milliseconds effort{99ms};
  auto governor = governor_of(
      [&](const Observation&) {
        host += effort;
        return wish("map.range_m", 3.0);
      },
      {0ms, 100ms, 3}, [&] { return host; });
  EXPECT_EQ(3.0, values(governor.decide(at(0ms))).at("map.range_m"));
  effort = 101ms;
  EXPECT_EQ(safe_default, values(governor.decide(at(250ms))));
  EXPECT_EQ(PolicyFault::overtime, governor.last_fault());
}

TEST(PolicyGovernor, is_not_concerned_with_host_time_when_it_has_no_clock) {
  auto governor =
      governor_of([](const Observation&) { return wish("map.range_m", 3.0); }, {0ms, 0ms, 1}, {});
  EXPECT_EQ(3.0, values(governor.decide(at(0ms))).at("map.range_m"));
}

TEST(PolicyGovernorDeathTest, refuses_to_be_made_without_a_policy) {
  EXPECT_DEATH(flyball::PolicyGovernor(nullptr, knobs(), {}, {}), "needs a policy");
}

TEST(PolicyFault, has_a_name_for_each_value) {
  EXPECT_EQ("none", to_string(PolicyFault::none));
  EXPECT_EQ("unknown_knob", to_string(PolicyFault::unknown_knob));
  EXPECT_EQ("not_finite", to_string(PolicyFault::not_finite));
  EXPECT_EQ("overflow", to_string(PolicyFault::overflow));
  EXPECT_EQ("overtime", to_string(PolicyFault::overtime));
}

}  // namespace
