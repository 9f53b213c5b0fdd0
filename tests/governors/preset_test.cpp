// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/preset.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace {

using flyball::ErrorCode;

class Preset : public testing::Test {
 protected:
  flyball::Result<flyball::Preset> load(const std::string& text) const {
    return flyball::load_preset(scratch_.file("preset.toml", text));
  }

  const ScratchFolder scratch_;
  const std::string path_ = scratch_.path("preset.toml");
};

TEST_F(Preset, has_a_policy_and_its_parameters) {
  const auto preset = load(R"(
description = "Fine where it matters"
policy = "density"
[parameters]
fine_m = 0.15
budget = 3
mode = "careful"
)");
  ASSERT_TRUE(preset.ok()) << preset.error().message;
  EXPECT_EQ("density", preset->policy);
  EXPECT_EQ("Fine where it matters", preset->description);
  const std::map<std::string, flyball::ParameterValue> expected{
      {"fine_m", 0.15}, {"budget", 3.0}, {"mode", std::string{"careful"}}};
  EXPECT_EQ(expected, preset->parameters);
}

TEST_F(Preset, needs_no_parameters) {
  const auto preset = load("policy = 'fixed'");
  ASSERT_TRUE(preset.ok());
  EXPECT_TRUE(preset->parameters.empty());
}

TEST_F(Preset, may_combine_an_application_with_a_clock) {
  const auto preset = load("application = 'two_level'\nclock = 'schedutil_10ms'");
  ASSERT_TRUE(preset.ok()) << preset.error().message;
  EXPECT_TRUE(preset->is_combination());
  EXPECT_EQ("two_level", preset->application);
  EXPECT_EQ("schedutil_10ms", preset->clock);
  EXPECT_FALSE(load("policy = 'fixed'")->is_combination());
  for (const std::string text :
       {"application = 'a'", "clock = 'a'", "policy = 'a'\napplication = 'b'\nclock = 'c'",
        "application = 'a'\nclock = 'b'\n[parameters]\nx = 1"}) {
    const auto refused = load(text);
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_NE(std::string::npos, refused.error().message.find(path_));
  }
}

TEST_F(Preset, names_file_and_line_of_each_problem_at_once) {
  const auto preset =
      load("policy = 'fixed'\ncolour = 1\n[parameters]\nfine_m = true\nat = 12:00:00\n");
  ASSERT_FALSE(preset.ok());
  EXPECT_EQ(ErrorCode::invalid_input, preset.error().code);
  for (const std::string part :
       {":2: \"colour\"", ":4: parameter \"fine_m\"", ":5: parameter \"at\""}) {
    EXPECT_NE(std::string::npos, preset.error().message.find(path_ + part))
        << preset.error().message;
  }
}

TEST_F(Preset, refuses_values_of_the_wrong_kind) {
  for (const std::string text : {"policy = 3", "policy = ''", "policy = 'a'\ndescription = 4",
                                 "policy = 'a'\nparameters = 5", "[policy]\nname = 'a'",
                                 "policy = 'a'\n[[parameters]]\na = 1"}) {
    const auto preset = load(text);
    ASSERT_FALSE(preset.ok()) << text;
    EXPECT_EQ(ErrorCode::invalid_input, preset.error().code);
    EXPECT_EQ(0U, preset.error().message.find(path_ + ":")) << preset.error().message;
  }
}

TEST_F(Preset, refuses_a_whole_number_that_no_double_holds) {
  const auto preset = load("policy = 'a'\nparameters = {n = 9007199254740993}");
  ASSERT_FALSE(preset.ok());
  EXPECT_EQ(path_ + ":2: parameter \"n\" is a whole number beyond 2^53; write 1.0e16",
            preset.error().message);
}

TEST_F(Preset, refuses_a_file_without_a_policy) {
  for (const std::string text : {"", "description = 'nothing else'"}) {
    const auto preset = load(text);
    ASSERT_FALSE(preset.ok());
    EXPECT_NE(std::string::npos, preset.error().message.find("no policy"));
  }
}

TEST_F(Preset, says_where_a_file_is_not_toml) {
  const auto preset = load("policy = 'fixed'\n\nresolution 0.15\n");
  ASSERT_FALSE(preset.ok());
  EXPECT_EQ(ErrorCode::invalid_input, preset.error().code);
  EXPECT_EQ(0U, preset.error().message.find(path_ + ":3: ")) << preset.error().message;
}

TEST_F(Preset, says_where_a_file_is_what_its_parser_must_not_see) {
  const auto preset = load("policy = 'fixed'\n[parameters]\nm\xcc\x9e = 1\n");
  ASSERT_FALSE(preset.ok());
  EXPECT_EQ(preset.error().message, path_ + ":3: letters outside of ASCII must stand in quotes");
}

TEST_F(Preset, is_not_found_where_no_file_is) {
  for (const std::string& path : {path_ + ".missing", scratch_.path()}) {
    const auto preset = flyball::load_preset(path);
    ASSERT_FALSE(preset.ok());
    EXPECT_EQ(ErrorCode::not_found, preset.error().code);
    EXPECT_NE(std::string::npos, preset.error().message.find(path));
  }
}

TEST_F(Preset, parameters_are_read_alone) {
  const auto given = flyball::read_parameters("fine_m = 0.2\nmapper = \"octomap\"  # a text\n");
  ASSERT_TRUE(given.ok()) << given.error().message;
  ASSERT_EQ(2U, given->size());
  EXPECT_EQ(0.2, std::get<double>(given->at("fine_m")));
  EXPECT_EQ("octomap", std::get<std::string>(given->at("mapper")));
  EXPECT_TRUE(flyball::read_parameters("")->empty());
  const auto wrong = flyball::read_parameters("fine_m = 0.2\ncoarse_m = true\n");
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ("parameters:2: parameter \"coarse_m\" must be a number or a text",
            wrong.error().message);
}

}  // namespace
