// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name (drivers/cpufreq/cpufreq_ondemand.c): above the threshold
// the highest clock at once, below it a clock in proportion to the load.

#include "flyball/governors/clock_policy.h"
#include "flyball/runtime/registry.h"

namespace {

class Ondemand final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"up_threshold", 0.8, 0.01, 1.0, "Load above which the clock is the highest."}};
  }
  [[nodiscard]] bool samples() const override { return true; }
  flyball::Status start(const flyball::Parameters& given,
                        const flyball::ClockTable& clocks) override {
    clocks_ = clocks;
    up_threshold_ = given.number("up_threshold");
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    if (sample.load > up_threshold_) {
      return clocks_.highest_hz();
    }
    const double span_hz = clocks_.highest_hz() - clocks_.lowest_hz();
    return clocks_.nearest_hz(clocks_.lowest_hz() + sample.load * span_hz);
  }

 private:
  flyball::ClockTable clocks_{};
  double up_threshold_{};
};

}  // namespace

FLYBALL_PLUGIN(ondemand) {
  registry.add<flyball::Policy>("ondemand", [] {
    return std::make_unique<flyball::ClockPolicy>("ondemand", std::make_unique<Ondemand>());
  });
}
