// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/policy_abilities.h"

#include "flyball/governors/policy_governor.h"

#include "rule_policy.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A policy that can do everything that only some can.
class Able final : public Policy,
                   public ChoosesPeriod,
                   public ComparesOptions,
                   public BoundsLatency {
 public:
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return {}; }
  Status start(const Parameters& /*given*/,
               const KnobSettings& /*knobs*/,
               const BoardModel& /*board*/) override {
    return Done{};
  }
  [[nodiscard]] Decision decide(const Observation& /*seen*/) noexcept override {
    Decision wish;
    wish.set("map.range_m", 5.0);
    return wish;
  }
  [[nodiscard]] std::optional<Duration> period() const override {
    return std::chrono::milliseconds{20};
  }
  [[nodiscard]] std::vector<PolicyOption> options() const override {
    return std::vector<PolicyOption>(2);
  }
  [[nodiscard]] BoundCount bounds() const noexcept override { return {10, 1, 1.5}; }
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const override {
    return {{0.15, 10, 1, 2.0}};
  }
};

TEST(PolicyAbilities, are_found_by_the_governor) {
  PolicyGovernor governor{std::make_unique<Able>(), kit::map_knobs(), {}, {}};
  EXPECT_EQ(governor.period(), Duration{std::chrono::milliseconds{20}});
  EXPECT_EQ(governor.options().size(), 2U);
  ASSERT_TRUE(governor.bounds());
  EXPECT_EQ(governor.bounds()->late, 1U);
  EXPECT_EQ(governor.bound_levels().size(), 1U);
}

TEST(PolicyAbilities, need_not_be_there) {
  PolicyGovernor governor{
      std::make_unique<kit::RulePolicy>([](const Observation&) { return Decision{}; }),
      kit::map_knobs(),
      {},
      {}};
  EXPECT_FALSE(governor.period());
  EXPECT_TRUE(governor.options().empty());
  EXPECT_FALSE(governor.bounds());
  EXPECT_TRUE(governor.bound_levels().empty());
  EXPECT_EQ(governor.remark(), "");
}

}  // namespace
}  // namespace flyball
