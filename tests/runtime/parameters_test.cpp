// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/parameters.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const std::vector<ParameterSpec> specs{
    {"spread_m", 40.0, 10.0, 200.0, "How far obstacles spread."},
    {"ground", std::string{"grass"}, 0.0, 0.0, "What it stands on.", {"grass", "sand"}},
    {"file", std::string{}, 0.0, 0.0, "Any text."},
};

std::vector<Error> errors_of(const std::map<std::string, ParameterValue>& given) {
  const auto resolved = Parameters::resolve("world \"forest\"", specs, given);
  const auto* errors = std::get_if<std::vector<Error>>(&resolved);
  return errors ? *errors : std::vector<Error>{};
}

TEST(Parameters, have_every_declared_value_given_or_default) {
  const auto resolved = Parameters::resolve("world \"forest\"", specs,
                                            {{"spread_m", 200.0}, {"file", std::string{"a.bt"}}});
  const auto& parameters = std::get<Parameters>(resolved);
  EXPECT_EQ(parameters.number("spread_m"), 200.0);
  EXPECT_EQ(parameters.text("ground"), "grass");
  EXPECT_EQ(parameters.text("file"), "a.bt");
  EXPECT_EQ(parameters.values().size(), 3U);
}

TEST(Parameters, name_both_sides_of_a_broken_bound) {
  const auto errors = errors_of({{"spread_m", 5.0}});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].code, ErrorCode::invalid_input);
  EXPECT_EQ(errors[0].message, "world \"forest\", spread_m: 5 is not within 10 to 200");
}

TEST(Parameters, report_all_faults_at_once) {
  const auto errors = errors_of({{"colour", 1.0}, {"ground", std::string{"mud"}}, {"file", 3.0}});
  ASSERT_EQ(errors.size(), 3U);
  EXPECT_EQ(errors[0].code, ErrorCode::not_found);
  EXPECT_EQ(errors[0].message,
            "world \"forest\" has no parameter \"colour\"; it has: spread_m, ground, file");
  EXPECT_EQ(errors[1].message, "world \"forest\", file: must be a text");
  EXPECT_EQ(errors[2].message, "world \"forest\", ground: \"mud\" is none of: grass, sand");
}

TEST(Parameters, that_are_declared_impossibly_are_refused_all_at_once) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ParameterSpec> impossible{{"a", 1.0, 2.0, 1.0, ""}, {"b", 1.0, nan, 1.0, ""},
                                              {"c", 1.0, 0.0, nan, ""}, {"d", nan, 0.0, 1.0, ""},
                                              {"e", 0.5, 0.0, 1.0, ""}, {"e", 0.5, 0.0, 1.0, ""}};
  const auto resolved = Parameters::resolve("policy \"mine\"", impossible, {});
  const auto* errors = std::get_if<std::vector<Error>>(&resolved);
  ASSERT_NE(nullptr, errors);
  ASSERT_EQ(5U, errors->size());
  EXPECT_EQ("policy \"mine\" declares \"a\" from 2 to 1; its minimum must not be above its maximum",
            (*errors)[0].message);
  EXPECT_EQ("policy \"mine\" declares \"d\" with a default that is no number",
            (*errors)[3].message);
  EXPECT_EQ("policy \"mine\" declares \"e\" twice", (*errors)[4].message);
}

TEST(Parameters, a_number_must_be_one) {
  EXPECT_EQ(errors_of({{"spread_m", std::numeric_limits<double>::quiet_NaN()}}).size(), 1U);
  EXPECT_EQ(errors_of({{"spread_m", std::numeric_limits<double>::infinity()}}).size(), 1U);
  EXPECT_EQ(errors_of({{"spread_m", std::string{"40"}}})[0].message,
            "world \"forest\", spread_m: must be a number");
}

TEST(ParametersDeathTest, asking_for_what_was_not_declared_is_a_mistake) {
  const auto resolved = Parameters::resolve("world", specs, {});
  const auto& parameters = std::get<Parameters>(resolved);
  EXPECT_DEATH((void)parameters.number("ground"), "no number \"ground\"");
  EXPECT_DEATH((void)parameters.text("colour"), "no text \"colour\"");
}

}  // namespace
TEST(Parameters, ask_for_a_required_one_that_is_missing) {
  ParameterSpec period{"period_s", 0.3, 0.0, 1.0, "How often."};
  period.required = true;
  const auto missing = Parameters::resolve("policy \"ondemand\"", {period}, {});
  const auto* errors = std::get_if<std::vector<Error>>(&missing);
  ASSERT_NE(errors, nullptr);
  EXPECT_NE(errors->front().message.find("period_s"), std::string::npos);
  const auto given = Parameters::resolve("x", {period}, {{"period_s", 0.01}});
  ASSERT_TRUE(std::holds_alternative<Parameters>(given));
  EXPECT_EQ(std::get<Parameters>(given).number("period_s"), 0.01);
}

}  // namespace flyball
