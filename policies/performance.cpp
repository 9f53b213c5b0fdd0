// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name: the highest clock, always.

#include "flyball/governors/clock_policy.h"

namespace {

class Performance final : public flyball::ClockRule {
 public:
  [[nodiscard]] bool samples() const override { return false; }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    return sample.clocks.highest_hz();
  }
};

}  // namespace

FLYBALL_PLUGIN(performance) {
  flyball::add_clock_policy<Performance>(registry, "performance");
}
