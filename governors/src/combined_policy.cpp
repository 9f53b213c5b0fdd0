// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/combined_policy.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

constexpr std::string_view clock_knob = "cpu.frequency_hz";

}  // namespace

CombinedPolicy::CombinedPolicy(std::unique_ptr<Policy> application,
                               std::unique_ptr<Policy> clock,
                               Duration application_period)
    : application_{std::move(application)},
      clock_{std::move(clock)},
      application_period_{application_period} {
  FLYBALL_ASSERT(application_ != nullptr && clock_ != nullptr, "two policies are combined");
  FLYBALL_ASSERT(application_period_.count() > 0, "application_period=%g s",
                 to_seconds(application_period_));
}

Status CombinedPolicy::start(const Parameters& /*given*/,
                             const KnobSettings& /*knobs*/,
                             const BoardModel& /*board*/) {
  return Done{};
}

std::optional<Duration> CombinedPolicy::period() const {
  const Duration application = application_->period().value_or(application_period_);
  return std::min(application, clock_->period().value_or(application));
}

Decision CombinedPolicy::decide(const Observation& seen) noexcept {
  if (!next_ || seen.now >= *next_) {
    wish_ = application_->decide(seen);
    next_ = seen.now + application_->period().value_or(application_period_);
  }
  Decision both;
  both.reason = wish_.reason;
  for (const auto& [knob, value] : wish_) {
    if (knob != clock_knob) {
      both.set(knob, value);
    }
  }
  for (const auto& [knob, value] : clock_->decide(seen)) {
    if (knob == clock_knob) {
      both.set(knob, value);
    }
  }
  return both;
}

}  // namespace flyball
