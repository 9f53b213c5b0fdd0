// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name (kernel/sched/cpufreq_schedutil.c): f = 1.25 f_max util.
// util is PELT's (kernel/sched/pelt.c): busy time weighted by the clock it ran at, forgotten with a
// half-life of 32 ms; so it means the same at any clock. The clock does not fall while the core has
// not idled: its utilisation may be low only because it is slow.

#include "flyball/governors/clock_policy.h"

#include <algorithm>
#include <cmath>

namespace {

class Schedutil final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"half_life_s", 0.032, 0.001, 10.0, "After which busy time counts half."},
            {"headroom", 1.25, 1.0, 4.0, "Clock over utilisation."}};
  }
  flyball::Status start(const flyball::Parameters& given,
                        const flyball::ClockTable& /*clocks*/) override {
    half_life_s_ = given.number("half_life_s");
    headroom_ = given.number("headroom");
    utilisation_ = 0.0;
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    const double highest_hz = sample.clocks.highest_hz();
    const double kept = std::exp2(-sample.elapsed_s / half_life_s_);
    utilisation_ = kept * utilisation_ + (1.0 - kept) * sample.load * sample.clock_hz / highest_hz;
    const double wished_hz = sample.clocks.at_or_above_hz(headroom_ * highest_hz * utilisation_);
    const bool has_idled = sample.load < 1.0 - rounding;
    return has_idled ? wished_hz : std::max(wished_hz, sample.clock_hz);
  }

 private:
  static constexpr double rounding = 1e-9;
  double half_life_s_{};
  double headroom_{};
  double utilisation_{};  ///< 0..1 of the highest clock.
};

}  // namespace

FLYBALL_PLUGIN(schedutil) {
  flyball::add_clock_policy<Schedutil>(registry, "schedutil");
}
