// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's rules, each held against its published formula on a Jetson TX2's clocks.

#include "policy_start.h"
#include "started_policy.h"
#include <cmath>

#include <gtest/gtest.h>

namespace {

using flyball::Hertz;
using flyball::MissionTime;
using flyball::Observation;
using Given = std::map<std::string, flyball::ParameterValue>;

const std::vector<double> tx2_khz{345600,  499200,  652800,  806400,  960000,  1113600,
                                  1267200, 1420800, 1574400, 1728000, 1881600, 2035200};

flyball::KnobSettings tx2_knobs() {
  flyball::KnobSpec clock;
  clock.name = "cpu.frequency_hz";
  for (const double khz : tx2_khz) {
    clock.legal.push_back(1e3 * khz);
  }
  clock.fallback = clock.legal.back();
  flyball::KnobSpec resolution;
  resolution.name = "map.resolution_m";
  resolution.min = 0.05;
  resolution.max = 2.0;
  resolution.fallback = 0.15;
  return flyball::KnobSettings{{clock, resolution}};
}

/// A computer under a rule: it grants what the rule asks for.
class Computer {
 public:
  Computer(const std::string& rule, Given given, double period_s, double first_mhz)
      : period_s_{period_s}, mhz_{first_mhz} {
    given.emplace("sampling_period_s", period_s);
    if (period_s == 0.0) {
      given.erase("sampling_period_s");
    }
    auto started = flyball::start_policy(rule, given, tx2_knobs());
    EXPECT_TRUE(started.status.ok()) << started.status.error().message;
    policy_ = std::move(started.policy);
    sample(0.0);  // the first one has no window behind it
    mhz_ = first_mhz;
  }
  /// The clock after one more sample with this load of the busiest core, in MHz.
  double sample(double load) {
    Observation seen;
    seen.now = MissionTime{flyball::from_seconds(period_s_ * samples_++)};
    seen.busiest_core_load = load;
    seen.frequency = Hertz{1e6 * mhz_};
    const auto decision = policy_->decide(seen);
    for (const auto& [knob, value] : decision) {
      mhz_ = knob == "cpu.frequency_hz" ? 1e-6 * value : mhz_;
    }
    return mhz_;
  }
  double after(int samples, double load) {
    for (int i = 0; i < samples; ++i) {
      sample(load);
    }
    return mhz_;
  }
  [[nodiscard]] const flyball::Policy& policy() const { return *policy_; }

 private:
  std::unique_ptr<flyball::Policy> policy_;
  double period_s_;
  double mhz_;
  int samples_{};
};

TEST(ClockRules, performance_and_powersave_do_not_look) {
  Computer performance{"performance", {}, 0.0, 806.4};
  EXPECT_DOUBLE_EQ(performance.sample(0.0), 2035.2);
  EXPECT_FALSE(flyball::kit::period(performance.policy()));
  Computer powersave{"powersave", {}, 0.0, 806.4};
  EXPECT_DOUBLE_EQ(powersave.sample(1.0), 345.6);
}

TEST(ClockRules, those_that_look_must_be_told_how_often) {
  for (const std::string rule : {"ondemand", "conservative", "schedutil", "interactive"}) {
    flyball::Registry registry;
    flyball::register_policies(registry);
    const auto specs = registry.make<flyball::Policy>(rule)->parameters();
    const auto resolved = flyball::Parameters::resolve(rule, specs, {});
    EXPECT_TRUE(std::holds_alternative<std::vector<flyball::Error>>(resolved)) << rule;
    const Computer computer{rule, {}, 0.01, 806.4};
    EXPECT_EQ(flyball::kit::period(computer.policy()),
              flyball::Duration{std::chrono::milliseconds{10}});
  }
}

TEST(ClockRules, pin_the_knobs_of_the_applications) {
  const auto rule = flyball::start_policy(
      "ondemand", {{"sampling_period_s", 0.3}, {"resolution_m", 0.3}}, tx2_knobs());
  ASSERT_TRUE(rule.status.ok());
  const auto decision = rule.policy->decide({});
  EXPECT_EQ(decision.size(), 2U);
  EXPECT_EQ(decision.begin()->knob, "map.resolution_m");
  EXPECT_EQ(decision.begin()->value, 0.3);
}

TEST(Ondemand, jumps_above_80_percent_and_is_proportional_below) {
  Computer computer{"ondemand", {}, 0.3, 960.0};
  EXPECT_DOUBLE_EQ(computer.sample(0.81), 2035.2);
  EXPECT_DOUBLE_EQ(computer.sample(0.80), 1728.0);  // 345.6 + .8 * 1689.6 = 1697.28
  EXPECT_DOUBLE_EQ(computer.sample(0.25), 806.4);   // 768.0 lies nearer to 806.4 than to 652.8
  EXPECT_DOUBLE_EQ(computer.sample(0.0), 345.6);
}

TEST(Conservative, moves_by_five_percent_of_the_highest_clock) {
  Computer computer{"conservative", {}, 0.3, 960.0};
  EXPECT_DOUBLE_EQ(computer.sample(0.9), 960.0);   // 1061.76 asked for, rounded down
  EXPECT_DOUBLE_EQ(computer.sample(0.9), 1113.6);  // 1163.52
  EXPECT_DOUBLE_EQ(computer.sample(0.5), 1113.6);  // between the thresholds: as it is
  EXPECT_DOUBLE_EQ(computer.sample(0.1), 1113.6);  // 1061.76, rounded up
  EXPECT_DOUBLE_EQ(computer.sample(0.1), 960.0);   // 960.0
  EXPECT_DOUBLE_EQ(computer.after(40, 0.95), 2035.2);
  EXPECT_DOUBLE_EQ(computer.after(40, 0.0), 345.6);
}

TEST(Conservative, refuses_thresholds_in_the_wrong_order) {
  EXPECT_FALSE(flyball::start_policy(
                   "conservative",
                   {{"sampling_period_s", 0.3}, {"up_threshold", 0.2}, {"down_threshold", 0.3}},
                   tx2_knobs())
                   .status.ok());
}

TEST(Schedutil, settles_a_quarter_above_the_utilisation) {
  Computer computer{"schedutil", {}, 0.01, 2035.2};
  // Work of 40 % of the highest clock: the load that the rule sees depends on the clock it chose.
  double mhz = 2035.2;
  for (int i = 0; i < 100; ++i) {
    mhz = computer.sample(std::min(1.0, 0.4 * 2035.2 / mhz));
  }
  EXPECT_DOUBLE_EQ(mhz, 1113.6);  // 1.25 * .4 * 2035.2 = 1017.6, the next one up
}

TEST(Schedutil, has_forgotten_half_after_32_ms) {
  Computer computer{"schedutil", {}, 0.032, 2035.2};
  EXPECT_DOUBLE_EQ(computer.after(30, 0.999), 2035.2);
  // util = .5, so 1.25 * .5 * 2035.2 = 1272: the next one up.
  EXPECT_DOUBLE_EQ(computer.sample(0.0), 1420.8);
}

TEST(Schedutil, does_not_fall_while_the_core_has_not_idled) {
  Computer computer{"schedutil", {}, 0.002, 1574.4};
  EXPECT_DOUBLE_EQ(computer.sample(1.0), 1574.4);  // util is still near 0
  EXPECT_LT(computer.sample(0.99), 1574.4);
}

TEST(Interactive, jumps_when_the_load_is_full) {
  Computer computer{"interactive", {{"hispeed_hz", 1.2672e9}}, 0.01, 652.8};
  EXPECT_DOUBLE_EQ(computer.sample(1.0), 1267.2);
  // 20 ms there before it goes on.
  EXPECT_DOUBLE_EQ(computer.sample(1.0), 1267.2);
  EXPECT_DOUBLE_EQ(computer.sample(1.0), 1420.8);  // 1267.2 / .9 = 1408
}

TEST(Interactive, takes_the_lowest_clock_that_meets_the_target_load) {
  Computer computer{"interactive", {}, 0.1, 2035.2};
  EXPECT_DOUBLE_EQ(computer.sample(0.5), 1267.2);  // .5 * 2035.2 / .9 = 1130.7
}

TEST(Interactive, falls_only_80_ms_after_the_clock_was_last_needed) {
  Computer computer{"interactive", {}, 0.02, 960.0};
  EXPECT_DOUBLE_EQ(computer.sample(1.0), 2035.2);
  EXPECT_DOUBLE_EQ(computer.after(3, 0.1), 2035.2);  // 60 ms
  EXPECT_DOUBLE_EQ(computer.sample(0.1), 345.6);     // 80 ms; .1 * 2035.2 / .9 = 226
}

}  // namespace
