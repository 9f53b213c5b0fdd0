// SPDX-License-Identifier: BSD-3-Clause
#include "started_policy.h"

#include <gtest/gtest.h>

namespace {

using flyball::start_policy;

std::map<std::string, double> wishes(flyball::Policy& policy) {
  std::map<std::string, double> all;
  const auto decision = policy.decide({});
  EXPECT_EQ(flyball::Reason::fixed, decision.reason);
  for (const auto& [knob, value] : decision) {
    all[std::string{knob}] = value;
  }
  return all;
}

TEST(Fixed, leaves_every_knob_alone_by_default) {
  const auto fixed = start_policy("fixed", {});
  ASSERT_TRUE(fixed.status.ok());
  EXPECT_TRUE(wishes(*fixed.policy).empty());
}

TEST(Fixed, sets_what_it_was_given_and_nothing_else) {
  const auto fixed = start_policy("fixed", {{"resolution_m", 0.80}, {"cores", 2.0}});
  ASSERT_TRUE(fixed.status.ok());
  const std::map<std::string, double> expected{{"map.resolution_m", 0.80}, {"cpu.cores", 2.0}};
  EXPECT_EQ(expected, wishes(*fixed.policy));
}

TEST(Fixed, reaches_every_knob_of_a_mission) {
  const auto fixed = start_policy("fixed", {{"resolution_m", 0.15},
                                            {"range_m", 7.0},
                                            {"rate_hz", 20.0},
                                            {"planner_budget", 40000.0},
                                            {"view_nodes", 15.0},
                                            {"view_threads", 1.0},
                                            {"cores", 4.0},
                                            {"frequency_hz", 2035.2e6},
                                            {"max_speed_m_s", 10.0}});
  ASSERT_TRUE(fixed.status.ok());
  const auto all = wishes(*fixed.policy);
  const auto knobs = flyball::conformance_knobs();
  for (const auto& spec : knobs.specs()) {
    EXPECT_EQ(spec.fallback, all.at(spec.name)) << spec.name;
  }
}

TEST(Fixed, refuses_a_value_that_its_knob_cannot_come_near) {
  using Given = std::map<std::string, flyball::ParameterValue>;
  for (const Given& given :
       {Given{{"resolution_m", 0.01}}, Given{{"resolution_m", 2.0}}, Given{{"cores", 8.0}},
        Given{{"frequency_hz", 5e9}}, Given{{"range_m", 1.0}}}) {
    const auto fixed = start_policy("fixed", given);
    ASSERT_FALSE(fixed.status.ok()) << given.begin()->first;
    EXPECT_EQ(flyball::ErrorCode::invalid_input, fixed.status.error().code);
    EXPECT_NE(std::string::npos, fixed.status.error().message.find(given.begin()->first));
  }
}

TEST(Fixed, refuses_a_knob_that_the_mission_does_not_have) {
  EXPECT_FALSE(start_policy("fixed", {{"cores", 2.0}}, flyball::KnobSettings{}).status.ok());
}

}  // namespace
