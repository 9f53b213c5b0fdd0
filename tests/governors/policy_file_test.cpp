// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/policy_file.h"

#include "policy_start.h"
#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

class Half final : public Policy {
 public:
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    return {{"range_m", 5.0, 1.0, 25.0, "Of the map."}};
  }
  Status start(const Parameters& given,
               const KnobSettings& /*knobs*/,
               const BoardModel& /*board*/) override {
    range_m_ = given.number("range_m");
    return Done{};
  }
  [[nodiscard]] Decision decide(const Observation& /*seen*/) noexcept override {
    Decision wish;
    wish.set("map.range_m", range_m_);
    return wish;
  }

 private:
  double range_m_{};
};

class PolicyFile : public testing::Test {
 protected:
  PolicyFile() {
    known_.add<Policy>("half", [] { return std::make_unique<Half>(); });
  }
  Result<PolicyChoice> load(const std::string& name, const std::string& text) const {
    return load_policy(scratch_.file(name, text), known_, 1);
  }
  std::string error_of(const std::string& name, const std::string& text) const {
    const auto choice = load(name, text);
    return choice ? "" : choice.error().message;
  }
  Registry known_;
  const ScratchFolder scratch_;
};

TEST_F(PolicyFile, a_preset_brings_parameters_for_a_policy_with_a_name) {
  const auto choice = load("mine.toml", "policy = 'half'\n[parameters]\nrange_m = 9\n");
  ASSERT_TRUE(choice.ok()) << choice.error().message;
  const auto policy = choice->started(conformance_knobs(), {});
  ASSERT_TRUE(policy.ok());
  EXPECT_EQ(9.0, kit::wish_for((*policy)->decide({}), "map.range_m"));
}

TEST_F(PolicyFile, what_is_wrong_with_parameters_is_said_at_once) {
  const auto choice =
      load("mine.toml", "policy = 'half'\n[parameters]\nrange_m = 90\ncolour = 'red'\n");
  ASSERT_TRUE(choice.ok());
  const auto policy = choice->started(conformance_knobs(), {});
  ASSERT_FALSE(policy.ok());
  EXPECT_NE(std::string::npos, policy.error().message.find("90 is not within 1 to 25"));
  EXPECT_NE(std::string::npos, policy.error().message.find("no parameter \"colour\""));
}

TEST_F(PolicyFile, a_library_is_loaded_and_a_preset_beside_it_sets_its_parameters) {
  const std::string library = std::string{FLYBALL_TEST_PLUGINS} + "/culprit.so";
  const auto bare = load_policy(library, known_, 1);
  ASSERT_TRUE(bare.ok()) << bare.error().message;
  EXPECT_TRUE(bare->started(conformance_knobs(), {}).ok());
  const std::string preset =
      scratch_.file("mine.toml", "policy = '" + library + "'\n[parameters]\ncrime = 8\n");
  const auto choice = load_policy(preset, known_, 1);
  ASSERT_TRUE(choice.ok()) << choice.error().message;
  const auto policy = choice->started(conformance_knobs(), {});
  ASSERT_FALSE(policy.ok());
  EXPECT_EQ(library + ": not today", policy.error().message);
  EXPECT_EQ((std::vector<std::string>{preset, library}), files_of_policy(preset));
}

TEST_F(PolicyFile, a_library_that_is_too_old_is_refused_in_one_sentence) {
  const std::string library = std::string{FLYBALL_TEST_PLUGINS} + "/culprit_too_old.so";
  const auto choice = load_policy(library, known_, 1);
  ASSERT_FALSE(choice.ok());
  EXPECT_NE(std::string::npos, choice.error().message.find("build it against the installed"));
}

TEST_F(PolicyFile, what_is_missing_or_of_no_kind_is_named) {
  EXPECT_NE("", error_of("mine.toml", "policy = 'quarter'"));
  EXPECT_NE("", error_of("mine.toml", "policy = 'gone.lua'"));
  EXPECT_NE("", error_of("mine.so", "text"));
  EXPECT_EQ(ErrorCode::not_found, load_policy(scratch_.path("gone.so"), known_, 1).error().code);
  EXPECT_NE(std::string::npos, error_of("mine.py", "").find("ends in .lua or .so"));
}

TEST_F(PolicyFile, is_known_by_its_ending) {
  EXPECT_TRUE(is_policy_file("./mine.toml") && is_policy_file("mine.lua") &&
              is_policy_file("/lib/libmine.so"));
  EXPECT_FALSE(is_policy_file("mission_energy") || is_policy_file("mine.py"));
}

#ifdef FLYBALL_HAS_LUA
TEST_F(PolicyFile, a_script_lies_beside_its_preset) {
  static_cast<void>(
      scratch_.file("mine.lua",
                    "parameters = {{name = 'range_m', default = 3, min = 1, max = 9,\n"
                    "               description = 'Of the map.'}}\n"
                    "function start(given) range_m = given.range_m end\n"
                    "function decide() return {['map.range_m'] = range_m} end"));
  const auto choice = load("mine.toml", "policy = 'mine.lua'\n[parameters]\nrange_m = 4\n");
  ASSERT_TRUE(choice.ok()) << choice.error().message;
  const auto policy = choice->started(conformance_knobs(), {});
  ASSERT_TRUE(policy.ok());
  EXPECT_EQ(4.0, kit::wish_for((*policy)->decide({}), "map.range_m"));
}
#endif

}  // namespace
}  // namespace flyball
