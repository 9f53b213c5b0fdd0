// SPDX-License-Identifier: BSD-3-Clause
// test-label: fault
#include "libraries/isolated_policy.h"

#include "libraries/library_policy.h"
#include "policy_start.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

std::string plugin(const std::string& name) {
  return std::string{FLYBALL_TEST_PLUGINS} + "/" + name + ".so";
}

PolicyMaker maker(const std::string& name) {
  return [name] { return LibraryPolicy::open(plugin(name), 1); };
}

IsolationLimits impatient() {
  IsolationLimits limits;
  limits.answer = 100ms;
  return limits;
}

IsolationLimits little_memory() {
  IsolationLimits limits;
  limits.answer = 60s;  // On a busy host pages come slowly.
  limits.memory_bytes = std::size_t{8} << 20U;
  return limits;
}

std::unique_ptr<IsolatedPolicy> isolated(const std::string& name,
                                         const IsolationLimits& limits = {}) {
  auto declaration = declaration_of(maker(name), limits);
  EXPECT_TRUE(declaration.ok()) << declaration.error().message;
  return std::make_unique<IsolatedPolicy>(name, maker(name), *declaration, limits);
}

enum Crime : std::uint8_t {
  none,
  nan_value,
  hang,
  crash,
  memory,
  unknown_knob,
  overflow,
  fail,
  refuse,
  random,
  leave
};

TEST(IsolatedPolicy, decides_what_the_policy_inside_decides) {
  const auto inside = maker("culprit")();
  ASSERT_TRUE(inside.ok());
  const auto outside = isolated("culprit");
  ASSERT_EQ(1U, outside->parameters().size());
  EXPECT_EQ("What it does wrong.", outside->parameters()[0].description);
  for (const Crime crime : {none, nan_value, unknown_knob, overflow, fail, random}) {
    const kit::GivenParameters given{{"crime", static_cast<double>(crime)}};
    ASSERT_TRUE(kit::start(**inside, given).ok());
    ASSERT_TRUE(kit::start(*outside, given).ok());
    for (const Observation& seen : plausible_observations(20)) {
      const Decision a = (*inside)->decide(seen);
      const Decision b = outside->decide(seen);
      EXPECT_EQ(a.reason, b.reason);
      EXPECT_EQ(a.overflowed(), b.overflowed()) << crime;
      EXPECT_EQ(kit::trouble(**inside), kit::trouble(*outside)) << crime;
      EXPECT_EQ(kit::remark(**inside), kit::remark(*outside)) << crime;
      if (crime == none || crime == random) {
        EXPECT_EQ(kit::wish_for(a, "map.resolution_m"), kit::wish_for(b, "map.resolution_m"));
      }
    }
  }
}

struct Fall {
  Crime crime;
  std::string sentence;
};

/// The address sanitizer catches crashes itself, and needs more memory than a policy may have.
std::vector<Fall> falls() {
  std::vector<Fall> all{{hang, "did not answer within 0.1 s; its process was ended"},
                        {leave, "its process ended by itself with exit code 7"}};
#ifndef __SANITIZE_ADDRESS__
  all.push_back({crash, "its process was ended by signal 11 (Segmentation fault)"});
  all.push_back({memory, "its process "});
#endif
  return all;
}

TEST(IsolatedPolicy, that_hangs_crashes_leaves_or_eats_memory_is_survived_in_one_sentence) {
  for (const Fall& fall : falls()) {
    const auto policy = isolated("culprit", fall.crime == hang ? impatient() : little_memory());
    ASSERT_TRUE(kit::start(*policy, {{"crime", static_cast<double>(fall.crime)}}).ok());
    EXPECT_EQ(0U, policy->decide({}).size());
    const std::string trouble{kit::trouble(*policy)};
    EXPECT_EQ(0U, trouble.find("culprit: " + fall.sentence)) << trouble;
    EXPECT_EQ(0U, policy->decide({}).size()) << "and is not asked again";
    EXPECT_EQ(trouble, kit::trouble(*policy));
  }
}

TEST(IsolatedPolicy, that_refuses_to_start_says_why) {
  const auto policy = isolated("culprit");
  const Status refused = kit::start(*policy, {{"crime", static_cast<double>(refuse)}});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(plugin("culprit") + ": not today", refused.error().message);
  const auto thrower = isolated("thrower");
  const Status thrown = kit::start(*thrower, {{"at_start", 1.0}});
  ASSERT_FALSE(thrown.ok());
  EXPECT_EQ("thrower: threw: no licence", thrown.error().message);
}

TEST(IsolatedPolicy, that_cannot_be_loaded_says_why) {
  const auto declaration = declaration_of(maker("missing"), {});
  ASSERT_FALSE(declaration.ok());
  EXPECT_EQ("no policy library " + plugin("missing"), declaration.error().message);
}

TEST(IsolatedPolicy, that_cannot_even_be_described_is_survived) {
  const PolicyMaker crashing = []() -> Result<std::unique_ptr<Policy>> { std::abort(); };
  const auto declaration = declaration_of(crashing, {});
  ASSERT_FALSE(declaration.ok());
  EXPECT_NE(std::string::npos, declaration.error().message.find("its process "));
}

}  // namespace
}  // namespace flyball
