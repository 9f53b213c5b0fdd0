// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/fixed_settings.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

KnobSettings fixed_knobs() {
  KnobSpec range;
  range.name = "map.range_m";
  range.min = 2.0;
  range.max = 25.0;
  range.fallback = 7.0;
  return KnobSettings{{range}};
}

Result<Decision> pinned(const std::map<std::string, ParameterValue>& given) {
  const auto resolved = Parameters::resolve("x", fixed_setting_parameters(), given);
  return fixed_settings("policy \"x\"", std::get<Parameters>(resolved), fixed_knobs());
}

TEST(FixedSettings, wish_only_what_was_given) {
  const auto none = pinned({});
  ASSERT_TRUE(none.ok());
  EXPECT_EQ(none->size(), 0U);
  const auto one = pinned({{"range_m", 12.0}});
  ASSERT_TRUE(one.ok());
  ASSERT_EQ(one->size(), 1U);
  EXPECT_EQ(one->begin()->knob, "map.range_m");
  EXPECT_EQ(one->begin()->value, 12.0);
}

TEST(FixedSettings, refuse_what_a_knob_cannot_be) {
  EXPECT_FALSE(pinned({{"range_m", 26.0}}).ok());
  EXPECT_FALSE(pinned({{"range_m", 0.1}}).ok());
  const auto missing = pinned({{"cores", 2.0}, {"planner_budget", 9.0}});  // no such knobs here
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().message,
            "policy \"x\": there is no knob planner.budget, cpu.cores; try: flyball list knobs");
}

TEST(FixedSettings, leave_the_clock_to_the_rules_that_turn_it) {
  for (const ParameterSpec& spec : fixed_setting_parameters()) {
    EXPECT_NE(spec.name, fixed_frequency_parameter().name);
  }
}

}  // namespace
}  // namespace flyball
