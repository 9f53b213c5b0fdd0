// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/combined_policy.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr std::string_view own_clock_knob = "cpu.frequency_hz";

std::optional<Duration> period_of(const Policy* policy) {
  const auto* chooses = dynamic_cast<const ChoosesPeriod*>(policy);
  return chooses != nullptr ? chooses->period() : std::nullopt;
}

bool is_sound(const Decision& wish, const KnobSettings& knobs) {
  return !wish.overflowed() && std::all_of(wish.begin(), wish.end(), [&knobs](const auto& one) {
    return std::isfinite(one.value) && knobs.spec(one.knob) != nullptr;
  });
}

}  // namespace

CombinedPolicy::CombinedPolicy(std::unique_ptr<Policy> application,
                               std::unique_ptr<Policy> clock,
                               Duration application_period,
                               const KnobSettings& knobs)
    : application_{std::move(application)},
      clock_{std::move(clock)},
      knobs_{knobs},
      bounds_{dynamic_cast<const BoundsLatency*>(application_.get())},
      options_{dynamic_cast<const ComparesOptions*>(application_.get())},
      application_code_{dynamic_cast<const HostsCode*>(application_.get())},
      clock_code_{dynamic_cast<const HostsCode*>(clock_.get())},
      own_period_{period_of(application_.get())},
      clock_period_{period_of(clock_.get())},
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
  const Duration application = own_period_.value_or(application_period_);
  return std::min(application, clock_period_.value_or(application));
}

BoundCount CombinedPolicy::bounds() const noexcept {
  return bounds_ != nullptr ? bounds_->bounds() : BoundCount{};
}

std::vector<LevelBounds> CombinedPolicy::bound_levels() const {
  return bounds_ != nullptr ? bounds_->bound_levels() : std::vector<LevelBounds>{};
}

std::vector<PolicyOption> CombinedPolicy::options() const {
  return options_ != nullptr ? options_->options() : std::vector<PolicyOption>{};
}

void CombinedPolicy::listen(const HostsCode* host) noexcept {
  if (host != nullptr) {
    trouble_ = trouble_.empty() ? host->trouble() : trouble_;
    remark_ = remark_.empty() ? host->remark() : remark_;
  }
}

Decision CombinedPolicy::decide(const Observation& seen) noexcept {
  trouble_ = remark_ = {};
  if (!next_ || seen.now >= *next_) {
    wish_ = application_->decide(seen);
    listen(application_code_);
    if (!trouble_.empty() || !is_sound(wish_, knobs_)) {
      return wish_;  // The governor counts faults in a row, so it has to see each answer once.
    }
    next_ = seen.now + own_period_.value_or(application_period_);
  }
  Decision both;
  both.reason = wish_.reason;
  for (const auto& [knob, value] : wish_) {
    if (knob != own_clock_knob) {
      both.set(knob, value);
    }
  }
  for (const auto& [knob, value] : clock_->decide(seen)) {
    if (knob == own_clock_knob) {
      both.set(knob, value);
    }
  }
  listen(clock_code_);
  return both;
}

}  // namespace flyball
