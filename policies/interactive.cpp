// SPDX-License-Identifier: BSD-3-Clause
//
// Android's cpufreq governor of this name (drivers/cpufreq/cpufreq_interactive.c of the vendor
// kernels, the TX2's too): jump when the load is high, then the lowest clock that keeps the load
// below its target; above the jump's clock and downwards only after a while.

#include "flyball/governors/clock_policy.h"

#include <algorithm>

namespace {

using flyball::Duration;
using flyball::MissionTime;

class Interactive final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {
        {"go_hispeed_load", 0.99, 0.01, 1.0, "Load at which the clock jumps."},
        {"hispeed_hz", 0.0, 0.0, 1e10, "Where it jumps to. 0: the highest clock."},
        {"target_load", 0.90, 0.01, 1.0, "Load that a clock should leave at most."},
        {"above_hispeed_delay_s", 0.020, 0.0, 10.0, "At the jump's clock before it rises more."},
        {"min_sample_time_s", 0.080, 0.0, 10.0, "At a clock before it falls."}};
  }
  flyball::Status start(const flyball::Parameters& given,
                        const flyball::ClockTable& clocks) override {
    go_hispeed_load_ = given.number("go_hispeed_load");
    target_load_ = given.number("target_load");
    const double hispeed_hz = given.number("hispeed_hz");
    hispeed_hz_ = hispeed_hz > 0.0 ? clocks.at_or_above_hz(hispeed_hz) : clocks.highest_hz();
    above_hispeed_delay_ = flyball::from_seconds(given.number("above_hispeed_delay_s"));
    min_sample_time_ = flyball::from_seconds(given.number("min_sample_time_s"));
    hispeed_since_ = floor_since_ = MissionTime{};
    floor_hz_ = clocks.lowest_hz();
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    const double now_hz = sample.clock_hz;
    const double wished_hz = wish_hz(sample);
    const bool waits_above = now_hz >= hispeed_hz_ && wished_hz > now_hz &&
                             sample.now - hispeed_since_ < above_hispeed_delay_;
    if (waits_above) {
      return now_hz;
    }
    hispeed_since_ = sample.now;
    if (wished_hz < floor_hz_ && sample.now - floor_since_ < min_sample_time_) {
      return now_hz;
    }
    floor_hz_ = wished_hz;
    floor_since_ = sample.now;
    return wished_hz;
  }

 private:
  [[nodiscard]] double wish_hz(const flyball::ClockSample& sample) const noexcept {
    // loadadj, the load times the clock, over the target: the lowest clock that meets it
    const double enough_hz =
        sample.clocks.at_or_above_hz(sample.load * sample.clock_hz / target_load_);
    if (sample.load < go_hispeed_load_) {
      return enough_hz;
    }
    return sample.clock_hz < hispeed_hz_ ? hispeed_hz_ : std::max(enough_hz, hispeed_hz_);
  }

  double go_hispeed_load_{};
  double target_load_{};
  double hispeed_hz_{};
  double floor_hz_{};
  Duration above_hispeed_delay_{};
  Duration min_sample_time_{};
  MissionTime hispeed_since_{};
  MissionTime floor_since_{};
};

}  // namespace

FLYBALL_PLUGIN(interactive) {
  flyball::add_clock_policy<Interactive>(registry, "interactive");
}
