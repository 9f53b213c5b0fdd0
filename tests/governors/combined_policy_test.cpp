// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/combined_policy.h"

#include "flyball/governors/policy_governor.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

KnobSettings two_knobs() {
  return KnobSettings{{{"map.resolution_m", "m", "map", {}, 0.1, 20.0, 0.15},
                       {"cpu.frequency_hz", "Hz", "platform", {}, 1e8, 1e11, 1e9}}};
}

/// Wishes for a map and a clock; counts how often it is asked.
class Wisher : public Policy, public ChoosesPeriod, public HostsCode {
 public:
  Wisher(double value, std::optional<Duration> period, int* asked)
      : value_{value}, period_{period}, asked_{asked} {}
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return {}; }
  Status start(const Parameters& /*given*/,
               const KnobSettings& /*knobs*/,
               const BoardModel& /*board*/) override {
    return Done{};
  }
  [[nodiscard]] std::optional<Duration> period() const override { return period_; }
  [[nodiscard]] std::string_view trouble() const noexcept override { return trouble_; }
  [[nodiscard]] std::string_view remark() const noexcept override { return {}; }
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override {
    ++*asked_;
    trouble_ = seen.speed_m_s > value_ ? "too fast" : "";
    Decision wish;
    wish.reason = value_ > 5.0 ? Reason::load : Reason::energy;
    wish.set(seen.battery_percent > 100.0 ? "map.unknown" : "map.resolution_m",
             seen.battery_percent < 0.0 ? std::nan("") : value_);
    wish.set("cpu.frequency_hz", 1e9 * value_);
    return wish;
  }

 private:
  double value_;
  std::optional<Duration> period_;
  int* asked_;
  std::string_view trouble_{};
};

/// Weighs two settings, too.
class Comparer final : public Wisher, public ComparesOptions {
 public:
  using Wisher::Wisher;
  [[nodiscard]] std::vector<PolicyOption> options() const override {
    return std::vector<PolicyOption>(2);
  }
};

struct Fixture {
  explicit Fixture(std::optional<Duration> clock_period)
      : policy{std::make_unique<Wisher>(1.0, std::nullopt, &application_asked),
               std::make_unique<Wisher>(9.0, clock_period, &clock_asked), 250ms, two_knobs()} {}
  Decision at(Duration t) {
    Observation seen;
    seen.now = MissionTime{t};
    return policy.decide(seen);
  }
  int application_asked{};
  int clock_asked{};
  CombinedPolicy policy;
};

TEST(CombinedPolicy, takes_the_clock_from_the_one_and_all_else_from_the_other) {
  Fixture both{10ms};
  const Decision wish = both.at(0ms);
  ASSERT_EQ(wish.size(), 2U);
  EXPECT_EQ(wish.begin()[0].knob, "map.resolution_m");
  EXPECT_EQ(wish.begin()[0].value, 1.0);
  EXPECT_EQ(wish.begin()[1].knob, "cpu.frequency_hz");
  EXPECT_EQ(wish.begin()[1].value, 9e9);
  EXPECT_EQ(wish.reason, Reason::energy);
}

TEST(CombinedPolicy, asks_each_at_its_own_pace) {
  Fixture both{10ms};
  EXPECT_EQ(both.policy.period(), Duration{10ms});
  for (int i = 0; i < 100; ++i) {  // A second.
    (void)both.at(10ms * i);
  }
  EXPECT_EQ(both.clock_asked, 100);
  EXPECT_EQ(both.application_asked, 4);
}

TEST(CombinedPolicy, tells_the_trouble_of_the_one_that_was_asked) {
  Fixture both{10ms};
  const auto trouble_at = [&both](Duration t, double speed_m_s) {
    Observation seen;
    seen.now = MissionTime{t};
    seen.speed_m_s = speed_m_s;
    static_cast<void>(both.policy.decide(seen));
    return std::string{both.policy.trouble()};
  };
  EXPECT_EQ(trouble_at(0ms, 0.0), "");
  EXPECT_EQ(trouble_at(10ms, 3.0), "") << "the application, which cannot, is not asked yet";
  EXPECT_EQ(trouble_at(250ms, 3.0), "too fast");
  EXPECT_EQ(trouble_at(260ms, 0.0), "") << "it is asked again at once";
  EXPECT_EQ(trouble_at(270ms, 3.0), "") << "and then at its own pace";
  EXPECT_EQ(trouble_at(280ms, 10.0), "too fast") << "the clock rule";
}

/// A governor that has asked the two for a second, told each time what the application cannot bear.
struct Governed {
  explicit Governed(const std::function<void(Observation&)>& disturb)
      : governor{
            std::make_unique<CombinedPolicy>(std::make_unique<Wisher>(1.0, std::nullopt, &asked),
                                             std::make_unique<Wisher>(9.0, 10ms, &asked),
                                             250ms,
                                             two_knobs()),
            two_knobs(),
            {},
            nullptr} {
    for (int i = 0; i < 100; ++i) {
      Observation seen;
      seen.now = MissionTime{10ms * i};
      seen.phase = MissionPhase::cruise;
      disturb(seen);
      faults += governor.decide(seen).reason == Reason::fallback ? 1 : 0;
    }
  }
  int asked{};
  PolicyGovernor governor;
  int faults{};
};

TEST(CombinedPolicy, is_given_up_when_the_application_fails_at_each_answer) {
  const Governed fails{[](Observation& seen) { seen.speed_m_s = 3.0; }};
  EXPECT_EQ(fails.faults, 100);
  EXPECT_TRUE(fails.governor.has_fallen_back());
}

TEST(CombinedPolicy, has_one_fault_where_the_application_gave_one_bad_answer) {
  for (const double percent : {-1.0, 101.0}) {  // Not a number; a knob that does not exist.
    const Governed once{[percent](Observation& seen) {
      seen.battery_percent = seen.now == MissionTime{} ? percent : 50.0;
    }};
    EXPECT_EQ(once.faults, 1) << percent;
    EXPECT_FALSE(once.governor.has_fallen_back()) << percent;
  }
}

TEST(CombinedPolicy, states_no_bounds_for_an_application_that_states_none) {
  const Fixture both{10ms};
  EXPECT_EQ(both.policy.bounds().issued, 0U);
  EXPECT_TRUE(both.policy.bound_levels().empty());
}

TEST(CombinedPolicy, shows_what_the_application_weighed) {
  int asked = 0;
  const CombinedPolicy compares{std::make_unique<Comparer>(1.0, std::nullopt, &asked),
                                std::make_unique<Comparer>(9.0, 10ms, &asked), 250ms, two_knobs()};
  const ComparesOptions& shows = compares;
  EXPECT_EQ(shows.options().size(), 2U);
  EXPECT_TRUE(Fixture{10ms}.policy.options().empty()) << "this one compares none";
}

TEST(CombinedPolicy, has_the_applications_pace_beside_a_rule_that_looks_at_nothing) {
  Fixture both{std::nullopt};
  EXPECT_EQ(both.policy.period(), Duration{250ms});
}

}  // namespace
}  // namespace flyball
