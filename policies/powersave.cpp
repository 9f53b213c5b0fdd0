// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name: the lowest clock, always.

#include "flyball/governors/clock_policy.h"

namespace {

class Powersave final : public flyball::ClockRule {
 public:
  [[nodiscard]] bool samples() const override { return false; }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    return sample.clocks.lowest_hz();
  }
};

}  // namespace

FLYBALL_PLUGIN(powersave) {
  flyball::add_clock_policy<Powersave>(registry, "powersave");
}
