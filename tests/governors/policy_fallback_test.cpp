// SPDX-License-Identifier: BSD-3-Clause
//
// What the governor does when the policy, or what it relies on, fails.
#include "flyball/governors/policy_governor.h"

#include "rule_policy.h"
#include <cmath>
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

flyball::PolicyGovernor governor_of(Rule rule) {
  return {std::make_unique<RulePolicy>(std::move(rule)), flyball::kit::map_knobs(), {}, {}};
}

Decision wish(std::string_view knob, double value) {
  Decision decision;
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

class Troubled final : public flyball::Policy, public flyball::HostsCode {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override { return {}; }
  flyball::Status start(const flyball::Parameters& /*given*/,
                        const flyball::KnobSettings& /*knobs*/,
                        const flyball::BoardModel& /*board*/) override {
    return flyball::Done{};
  }
  [[nodiscard]] Decision decide(const Observation& /*seen*/) noexcept override {
    return wish("map.range_m", 5.0);
  }
  [[nodiscard]] std::string_view trouble() const noexcept override { return "mine.lua:3: broken"; }
  [[nodiscard]] std::string_view remark() const noexcept override { return "oh"; }
};

TEST(PolicyGovernor, says_in_one_sentence_why_it_fell_back) {
  flyball::PolicyGovernor troubled{std::make_unique<Troubled>(), flyball::kit::map_knobs(), {}, {}};
  EXPECT_EQ(safe_default, values(troubled.decide(at(0ms))));
  EXPECT_EQ(PolicyFault::failed, troubled.last_fault());
  EXPECT_EQ(flyball::Fallback::safe_static, troubled.fallback());
  EXPECT_EQ("mine.lua:3: broken", troubled.why());
  EXPECT_EQ("oh", troubled.remark());
  static_cast<void>(troubled.decide(at(1s)));
  static_cast<void>(troubled.decide(at(2s)));
  static_cast<void>(troubled.decide(at(3s)));
  EXPECT_EQ("the policy failed 3 times in a row and is not asked any more", troubled.why());
  EXPECT_EQ("", troubled.remark()) << "it was not asked";

  auto nan = governor_of([](const Observation&) { return wish("map.range_m", std::nan("")); });
  static_cast<void>(nan.decide(at(0ms)));
  EXPECT_EQ("the policy's wish for map.range_m is not a finite number", nan.why());
  auto unknown = governor_of([](const Observation&) { return wish("map.colour", 1.0); });
  static_cast<void>(unknown.decide(at(0ms)));
  EXPECT_EQ("the policy wishes for a knob that does not exist: \"map.colour\"", unknown.why());
}

/// Also with a clock to ask for.
flyball::KnobSettings knobs_with_clock() {
  flyball::KnobSettings settings{
      {{"map.range_m", "m", "mapper", {}, 2.0, 10.0, 7.0, ""},
       {"cpu.frequency_hz", "Hz", "platform", {1e9, 2e9}, 1e9, 2e9, 1e9, ""}}};
  return settings;
}

TEST(PolicyGovernor, takes_the_table_at_top_clock_and_does_not_ask_while_input_is_invalid) {
  int asked = 0;
  flyball::PolicyGovernor governor{std::make_unique<RulePolicy>([&asked](const Observation&) {
                                     ++asked;
                                     return wish("map.range_m", 3.0);
                                   }),
                                   knobs_with_clock(),
                                   {},
                                   {}};
  EXPECT_EQ(3.0, values(governor.decide(at(0ms))).at("map.range_m"));
  Observation broken = at(250ms);
  broken.obstacle_density = std::nan("");
  const std::map<std::string, double> table{{"map.range_m", 7.0}, {"cpu.frequency_hz", 2e9}};
  EXPECT_EQ(table, values(governor.decide(broken)));
  EXPECT_EQ(flyball::Fallback::table, governor.fallback());
  EXPECT_EQ(1, asked);
  EXPECT_EQ(PolicyFault::none, governor.last_fault()) << "it is not the policy's";
  EXPECT_GT(governor.bound_factor(), 1.0);
  EXPECT_EQ(3.0, values(governor.decide(at(2s))).at("map.range_m")) << "and it goes on";
  EXPECT_EQ(1.0, governor.bound_factor());
}

TEST(PolicyGovernor, hovers_while_deadlines_are_missed_again_and_again) {
  auto governor = governor_of([](const Observation&) { return wish("map.range_m", 3.0); });
  Observation missing = at(0ms);
  missing.deadline_misses = 10;
  EXPECT_EQ(7.0, values(governor.decide(missing)).at("map.range_m"));
  EXPECT_TRUE(governor.must_hover());
  static_cast<void>(governor.decide(at(20s)));
  EXPECT_FALSE(governor.must_hover());
}

TEST(PolicyGovernor, widens_the_bound_and_lets_the_policy_go_on_when_maps_are_late) {
  auto governor = governor_of([](const Observation&) { return wish("map.range_m", 3.0); });
  Observation late = at(0ms);
  for (int i = 0; i < 3; ++i) {
    late.now += 500ms;
    ++late.map_revision;
    late.latency = i == 0 ? 50ms : 200ms;
    late.latency_bound = 100ms;
    EXPECT_EQ(3.0, values(governor.decide(late)).at("map.range_m"));
  }
  EXPECT_EQ(flyball::Fallback::wide_bound, governor.fallback());
  EXPECT_EQ(1.5, governor.bound_factor());
}

}  // namespace
