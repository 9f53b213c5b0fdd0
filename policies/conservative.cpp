// SPDX-License-Identifier: BSD-3-Clause
//
// Linux's cpufreq governor of this name (drivers/cpufreq/cpufreq_conservative.c): one step up or
// down at a time. The request moves by whole steps; the clock is the nearest one that is not past
// it.

#include "flyball/governors/clock_policy.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>

namespace {

class Conservative final : public flyball::ClockRule {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"up_threshold", 0.8, 0.01, 1.0, "Load above which the clock rises."},
            {"down_threshold", 0.2, 0.0, 1.0, "Load below which the clock falls."},
            {"step", 0.05, 0.001, 1.0, "Of the highest clock."}};
  }
  flyball::Status start(const flyball::Parameters& given,
                        const flyball::ClockTable& clocks) override {
    up_threshold_ = given.number("up_threshold");
    down_threshold_ = given.number("down_threshold");
    step_hz_ = given.number("step") * clocks.highest_hz();
    request_hz_ = 0.0;
    if (down_threshold_ >= up_threshold_) {
      return flyball::Error{
          flyball::ErrorCode::invalid_input,
          "policy \"conservative\": down_threshold = " +
              flyball::short_number_text(down_threshold_) +
              " must be below up_threshold = " + flyball::short_number_text(up_threshold_)};
    }
    return flyball::Done{};
  }
  [[nodiscard]] double next_hz(const flyball::ClockSample& sample) noexcept override {
    if (request_hz_ == 0.0) {
      request_hz_ = sample.clock_hz;
    }
    if (sample.load > up_threshold_) {
      request_hz_ = std::min(sample.clocks.highest_hz(), request_hz_ + step_hz_);
      return sample.clocks.at_or_below_hz(request_hz_);
    }
    if (sample.load < down_threshold_) {
      request_hz_ = std::max(sample.clocks.lowest_hz(), request_hz_ - step_hz_);
      return sample.clocks.at_or_above_hz(request_hz_);
    }
    return sample.clock_hz;
  }

 private:
  double up_threshold_{};
  double down_threshold_{};
  double step_hz_{};
  double request_hz_{};  ///< 0: nothing was sampled yet.
};

}  // namespace

FLYBALL_PLUGIN(conservative) {
  flyball::add_clock_policy<Conservative>(registry, "conservative");
}
