// SPDX-License-Identifier: BSD-3-Clause
#include "governed_loop.h"
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

TEST(EmbeddedSignals, are_all_that_a_policy_can_know_with_unit_and_description) {
  const GovernedLoop loop;
  std::string names;
  std::size_t signals = 0;
  for (const auto& [name, entry] : loop.list()) {
    EXPECT_EQ(std::uint32_t{flyball_governor_signal}, entry.kind) << name;
    EXPECT_EQ(0U, entry.is_known) << name;
    EXPECT_STRNE("", entry.unit) << name;
    EXPECT_LT(10U, std::string{entry.description}.size()) << name;
    const std::string unit = entry.unit;
    const bool says_unit = name.size() > 2 && name.compare(name.size() - 2, 2, "_s") == 0;
    EXPECT_EQ(says_unit, unit == "s" || unit == "m/s") << name << " in " << unit;
    ++signals;
  }
  EXPECT_EQ(58U, signals) << "as in flyball/runtime/observation_fields.h";
}

TEST(EmbeddedSignals, are_listed_with_what_was_observed) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(flyball_governor_ok, loop.observe("speed_m_s", 3.5));
  EXPECT_EQ(3.5, loop.signal("speed_m_s"));
  EXPECT_EQ(1U, loop.list().at("speed_m_s").is_known);
}

TEST(EmbeddedSignals, that_nobody_knows_are_refused_by_name) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(flyball_governor_not_found, loop.observe("speed", 3.5));
  EXPECT_EQ("there is no signal \"speed\"; flyball_governor_list has them all", loop.error());
  EXPECT_EQ(flyball_governor_not_found, loop.observe(nullptr, 3.5));
  EXPECT_EQ(0.80, loop.decide(0.0).decided[0]) << "nothing has happened";
}

TEST(EmbeddedSignals, refuse_what_cannot_be) {
  GovernedLoop loop;
  loop.open_density();
  loop.observe("cores", 4.0);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("phase", 4.0));
  EXPECT_EQ("signal phase cannot be 4", loop.error());
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("cores", 2.5));
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("map_revision", -1.0));
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("latency_s", infinite));
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("latency_s", 1e12));
  EXPECT_EQ(4.0, loop.signal("cores")) << "it stays as it was";
}

TEST(EmbeddedSignals, that_cannot_be_believed_are_met_by_the_governor) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(flyball_governor_ok, loop.observe("speed_m_s", -1.0));
  EXPECT_STREQ("table", loop.decide(0.0).fallback);
}

TEST(EmbeddedSignals, that_were_refused_are_named_until_they_are_observed_anew) {
  GovernedLoop loop;
  loop.open_density();
  loop.observe("speed_m_s", 2.5);
  EXPECT_EQ(flyball_governor_invalid_input, loop.observe("cores", 2.5));
  const FlyballGovernorDecision refused = loop.decide(0.0);
  EXPECT_STREQ("table", refused.fallback);
  EXPECT_STREQ("signal cores was observed with a value that it cannot have", refused.why);
  EXPECT_NE(std::string::npos, loop.lines.at(0).find(" speed_m_s=2.5 ")) << loop.lines.at(0);
  loop.observe("cores", 2.0);
  EXPECT_STREQ("", loop.decide(1.0).why);
}

TEST(EmbeddedSignals, follow_the_knobs_in_force) {
  GovernedLoop loop;
  loop.add(loop.clock_knob());
  loop.open_density();
  loop.decide(0.0);
  EXPECT_EQ(1.0e9, loop.signal("frequency_hz"));
  EXPECT_EQ(0.15, loop.signal("map_resolution_m")) << "as it was when it was decided";
  loop.decide(1.0);
  EXPECT_EQ(0.80, loop.signal("map_resolution_m"));
  loop.observe("frequency_hz", 1.5e9);
  loop.decide(2.0);
  EXPECT_EQ(1.5e9, loop.signal("frequency_hz")) << "who observes is believed";
}

TEST(EmbeddedSignals, that_count_since_a_decision_begin_anew_with_each) {
  GovernedLoop loop;
  loop.open_density();
  loop.observe("queue_drops", 3.0);
  loop.observe("deadline_misses", 1.0);
  loop.decide(0.0);
  EXPECT_EQ(0.0, loop.signal("queue_drops"));
  EXPECT_EQ(0.0, loop.signal("deadline_misses"));
}

TEST(EmbeddedSignals, take_each_observed_latency_for_a_frame) {
  GovernedLoop loop;
  loop.open_density();
  EXPECT_EQ(0.0, loop.decide(0.0).latency_bound_s) << "nothing is known";
  loop.observe("latency_s", 0.2);
  loop.observe("latency_s", 0.1);
  const FlyballGovernorDecision decision = loop.decide(1.0);
  EXPECT_NEAR(0.22, decision.latency_bound_s, 1e-9);
  EXPECT_EQ(2.0, loop.signal("map_revision"));
  EXPECT_NEAR(0.22, loop.signal("latency_bound_s"), 1e-9);
}

}  // namespace
}  // namespace flyball::kit
