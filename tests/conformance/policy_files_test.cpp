// SPDX-License-Identifier: BSD-3-Clause
//
// The three kinds of policy that somebody brings in a file, by the examples of each: the same rule
// keeps the same contract and decides the same.
#ifdef FLYBALL_EXAMPLES

#include "flyball/governors/policy_conformance.h"
#include "flyball/scenario/policy_choice.h"

#include "policy_start.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::vector<std::string> examples() {
  return {
      FLYBALL_EXAMPLES "/density_switch.toml",
#ifdef FLYBALL_HAS_LUA
      FLYBALL_EXAMPLES "/density_switch.lua",
#endif
      FLYBALL_EXAMPLE_LIBRARY,
  };
}

PolicyChoice chosen(const std::string& file) {
  auto choice = choose_policy(file, Plugins{}, 1);
  EXPECT_TRUE(choice.ok()) << choice.error().message;
  return *choice;
}

TEST(PolicyFiles, keep_the_contract_of_a_policy) {
  for (const std::string& file : examples()) {
    const PolicyChoice choice = chosen(file);
    const auto breaches = PolicyConformance{
        {[&choice] { return std::move(*choice.make()); },
         choice.parameters}}.breaches();
    EXPECT_TRUE(breaches.empty()) << file << " " << breaches.front();
  }
}

TEST(PolicyFiles, of_one_rule_decide_the_same) {
  std::vector<std::unique_ptr<Policy>> policies;
  for (const std::string& file : examples()) {
    auto policy = chosen(file).started(conformance_knobs(), conformance_board());
    ASSERT_TRUE(policy.ok()) << policy.error().message;
    policies.push_back(std::move(*policy));
  }
  int changes = 0;
  double last = 0.0;
  for (const Observation& seen : plausible_observations(400)) {
    const Decision first = policies.front()->decide(seen);
    ASSERT_EQ(1U, first.size());
    changes += first.begin()->value != last ? 1 : 0;
    last = first.begin()->value;
    for (const auto& policy : policies) {
      const Decision other = policy->decide(seen);
      ASSERT_EQ(1U, other.size()) << kit::trouble(*policy);
      EXPECT_EQ(first.begin()->knob, other.begin()->knob);
      EXPECT_EQ(first.begin()->value, other.begin()->value);
      EXPECT_EQ(first.reason, other.reason);
    }
  }
  EXPECT_GT(changes, 10) << "nothing was compared";
}

#ifdef FLYBALL_HAS_LUA
TEST(PolicyFiles, a_script_of_a_shipped_rule_decides_as_the_rule_does) {
  const PolicyChoice script = chosen(FLYBALL_EXAMPLES "/gap_switch.lua");
  const auto breaches = PolicyConformance{
      {[&script] { return std::move(*script.make()); },
       script.parameters}}.breaches();
  EXPECT_TRUE(breaches.empty()) << breaches.front();

  const auto scripted = script.started(conformance_knobs(), conformance_board());
  ASSERT_TRUE(scripted.ok()) << scripted.error().message;
  const auto shipped = chosen("gap_switch").started(conformance_knobs(), conformance_board());
  ASSERT_TRUE(shipped.ok()) << shipped.error().message;
  int changes = 0;
  double last_m = 0.0;
  for (Observation seen : plausible_observations(400)) {
    // They tell of failed plans in three of four, after each of which the finest cells last.
    seen.planner_failures = seen.map_revision % 20 == 0 ? seen.planner_failures : 0;
    const Decision expected = (*shipped)->decide(seen);
    const Decision decided = (*scripted)->decide(seen);
    ASSERT_EQ(expected.size(), decided.size()) << kit::trouble(**scripted);
    for (const auto& [knob, value] : expected) {
      EXPECT_EQ(value, kit::wish_for(decided, knob)) << knob;
    }
    const double cells_m = *kit::wish_for(expected, "map.resolution_m");
    changes += cells_m != last_m ? 1 : 0;
    last_m = cells_m;
  }
  EXPECT_GT(changes, 10) << "nothing was compared";
}
#endif

TEST(PolicyFiles, with_wrong_parameters_refuse_in_one_sentence) {
  for (const std::string& file : examples()) {
    PolicyChoice choice = chosen(file);
    choice.parameters = {{"fine_m", 0.9}, {"coarse_m", 0.6}};
    const auto policy = choice.started(conformance_knobs(), conformance_board());
    ASSERT_FALSE(policy.ok()) << file;
    EXPECT_NE(std::string::npos, policy.error().message.find("must be below")) << file;
    EXPECT_EQ(std::string::npos, policy.error().message.find('\n'));
  }
}

}  // namespace
}  // namespace flyball

#endif
