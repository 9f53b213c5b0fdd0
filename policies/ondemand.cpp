// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name (drivers/cpufreq/cpufreq_ondemand.c): above the threshold
// the highest clock at once, below it a clock in proportion to the load.

#include "flyball/governors/clock_policy.h"

namespace {

class Ondemand final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"up_threshold", 0.8, 0.01, 1.0, "Load above which the clock is the highest."}};
  }
  flyball::Status start(const flyball::Parameters& given,
                        const flyball::ClockTable& /*clocks*/) override {
    up_threshold_ = given.number("up_threshold");
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    if (sample.load > up_threshold_) {
      return sample.clocks.highest_hz();
    }
    const double span_hz = sample.clocks.highest_hz() - sample.clocks.lowest_hz();
    return sample.clocks.nearest_hz(sample.clocks.lowest_hz() + sample.load * span_hz);
  }

 private:
  double up_threshold_{};
};

}  // namespace

FLYBALL_PLUGIN(ondemand) {
  flyball::add_clock_policy<Ondemand>(registry, "ondemand");
}
