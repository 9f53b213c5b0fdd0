// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name: the highest clock, always.

#include "flyball/governors/clock_policy.h"
#include "flyball/runtime/registry.h"

namespace {

class Performance final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override { return {}; }
  [[nodiscard]] bool samples() const override { return false; }
  flyball::Status start(const flyball::Parameters& /*given*/,
                        const flyball::ClockTable& clocks) override {
    highest_hz_ = clocks.highest_hz();
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& /*sample*/) noexcept override {
    return highest_hz_;
  }

 private:
  double highest_hz_{};
};

}  // namespace

FLYBALL_PLUGIN(performance) {
  registry.add<flyball::Policy>("performance", [] {
    return std::make_unique<flyball::ClockPolicy>("performance", std::make_unique<Performance>());
  });
}
