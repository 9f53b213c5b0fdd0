// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/clock_policy.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(ClockTable, rounds_up_down_and_to_the_nearest) {
  const ClockTable clocks{{1e9, 1.5e9, 2e9}};
  EXPECT_EQ(clocks.at_or_above_hz(1.2e9), 1.5e9);
  EXPECT_EQ(clocks.at_or_below_hz(1.2e9), 1e9);
  EXPECT_EQ(clocks.nearest_hz(1.2e9), 1e9);
  EXPECT_EQ(clocks.nearest_hz(1.3e9), 1.5e9);
  for (const double exact : {1e9, 1.5e9, 2e9}) {
    EXPECT_EQ(clocks.at_or_above_hz(exact), exact);
    EXPECT_EQ(clocks.at_or_below_hz(exact), exact);
  }
  EXPECT_EQ(clocks.at_or_above_hz(9e9), 2e9);
  EXPECT_EQ(clocks.at_or_below_hz(1.0), 1e9);
}

/// Writes down what it is shown.
class Witness final : public ClockRule {
 public:
  explicit Witness(std::vector<ClockSample>& seen) : seen_{seen} {}
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return {}; }
  [[nodiscard]] bool samples() const override { return true; }
  Status start(const Parameters& /*given*/, const ClockTable& /*clocks*/) override {
    return Done{};
  }
  [[nodiscard]] double next_hz(const ClockSample& sample) noexcept override {
    seen_.push_back(sample);
    return 1e9;
  }

 private:
  std::vector<ClockSample>& seen_;
};

KnobSettings knobs() {
  KnobSpec clock;
  clock.name = "cpu.frequency_hz";
  clock.legal = {1e9, 2e9};
  clock.fallback = 2e9;
  return KnobSettings{{clock}};
}

std::unique_ptr<ClockPolicy> started(std::vector<ClockSample>& seen) {
  auto policy = std::make_unique<ClockPolicy>("witness", std::make_unique<Witness>(seen));
  const auto given =
      Parameters::resolve("witness", policy->parameters(), {{"sampling_period_s", 0.1}});
  EXPECT_TRUE(policy->start(std::get<Parameters>(given), knobs(), {}).ok());
  return policy;
}

TEST(ClockPolicy, shows_its_rule_a_window_that_has_passed) {
  std::vector<ClockSample> samples;
  const auto policy = started(samples);
  Observation seen;
  seen.frequency = Hertz{2e9};
  seen.busiest_core_load = 0.7;
  EXPECT_EQ(policy->decide(seen).begin()->value, 2e9);  // no window yet: as it is
  seen.now += std::chrono::milliseconds{100};
  EXPECT_EQ(policy->decide(seen).begin()->value, 1e9);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_NEAR(samples[0].elapsed_s, 0.1, 1e-12);
  EXPECT_EQ(samples[0].load, 0.7);
  EXPECT_EQ(samples[0].clock_hz, 2e9);
}

TEST(ClockPolicy, shows_its_rule_nothing_that_makes_no_sense) {
  std::vector<ClockSample> samples;
  const auto policy = started(samples);
  Observation seen;
  static_cast<void>(policy->decide(seen));
  for (const double broken : {std::nan(""), -1.0, 1e300}) {
    seen.now += std::chrono::milliseconds{100};
    seen.frequency = Hertz{broken};
    seen.busiest_core_load = broken;
    static_cast<void>(policy->decide(seen));
    EXPECT_GE(samples.back().load, 0.0);
    EXPECT_LE(samples.back().load, 1.0);
    EXPECT_TRUE(samples.back().clock_hz == 1e9 || samples.back().clock_hz == 2e9);
  }
}

TEST(ClockPolicy, refuses_a_computer_without_a_list_of_clocks) {
  std::vector<ClockSample> samples;
  ClockPolicy policy{"witness", std::make_unique<Witness>(samples)};
  const auto given =
      Parameters::resolve("witness", policy.parameters(), {{"sampling_period_s", 0.1}});
  EXPECT_FALSE(policy.start(std::get<Parameters>(given), {}, {}).ok());
}

}  // namespace
}  // namespace flyball
