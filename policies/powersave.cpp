// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name: the lowest clock, always.

#include "flyball/governors/clock_policy.h"
#include "flyball/runtime/registry.h"

namespace {

class Powersave final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override { return {}; }
  [[nodiscard]] bool samples() const override { return false; }
  flyball::Status start(const flyball::Parameters& /*given*/,
                        const flyball::ClockTable& clocks) override {
    lowest_hz_ = clocks.lowest_hz();
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& /*sample*/) noexcept override {
    return lowest_hz_;
  }

 private:
  double lowest_hz_{};
};

}  // namespace

FLYBALL_PLUGIN(powersave) {
  registry.add<flyball::Policy>("powersave", [] {
    return std::make_unique<flyball::ClockPolicy>("powersave", std::make_unique<Powersave>());
  });
}
