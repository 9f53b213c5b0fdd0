// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/clock_policy.h"

#include "flyball/governors/fixed_settings.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr const char* knob = "cpu.frequency_hz";

ParameterSpec sampling_period() {
  ParameterSpec spec{
      "sampling_period_s", 0.3, 4.5e-4, 10.0,
      "How often the rule looks. Kernel 4.x on the TX2: .3; newer: .01, .002, .00045."};
  spec.required = true;
  return spec;
}

}  // namespace

ClockTable::ClockTable(std::vector<double> clocks_hz) : clocks_hz_{std::move(clocks_hz)} {
  FLYBALL_ASSERT(!clocks_hz_.empty() && std::is_sorted(clocks_hz_.begin(), clocks_hz_.end()),
                 "%zu clocks", clocks_hz_.size());
}

double ClockTable::at_or_above_hz(double wish_hz) const {
  const auto found = std::lower_bound(clocks_hz_.begin(), clocks_hz_.end(), wish_hz);
  return found == clocks_hz_.end() ? highest_hz() : *found;
}

double ClockTable::at_or_below_hz(double wish_hz) const {
  const auto above = std::upper_bound(clocks_hz_.begin(), clocks_hz_.end(), wish_hz);
  return above == clocks_hz_.begin() ? lowest_hz() : *(above - 1);
}

double ClockTable::nearest_hz(double wish_hz) const {
  const double low = at_or_below_hz(wish_hz);
  const double high = at_or_above_hz(wish_hz);
  return wish_hz - low <= high - wish_hz ? low : high;
}

ClockPolicy::ClockPolicy(std::string name, std::unique_ptr<ClockRule> rule)
    : name_{std::move(name)}, rule_{std::move(rule)} {
  FLYBALL_ASSERT(rule_ != nullptr, "policy %s has no rule", name_.c_str());
}

std::vector<ParameterSpec> ClockPolicy::parameters() const {
  auto specs = fixed_setting_parameters();
  if (rule_->samples()) {
    specs.push_back(sampling_period());
  }
  for (auto& spec : rule_->parameters()) {
    specs.push_back(std::move(spec));
  }
  return specs;
}

Status ClockPolicy::start(const Parameters& given,
                          const KnobSettings& knobs,
                          const BoardModel& /*board*/) {
  const std::string owner = "policy \"" + name_ + "\"";
  const KnobSpec* spec = knobs.spec(knob);
  if (spec == nullptr || spec->legal.empty()) {
    return Error{ErrorCode::invalid_input,
                 owner + ": there is no knob " + knob + " with a list of clocks"};
  }
  auto fixed = fixed_settings(owner, given, knobs);
  if (!fixed) {
    return fixed.error();
  }
  fixed_ = *fixed;
  fixed_.reason = Reason::load;
  clocks_ = ClockTable{spec->legal};
  in_force_hz_ = knobs.value(knob);
  last_.reset();
  period_.reset();
  if (rule_->samples()) {
    period_ = from_seconds(given.number("sampling_period_s"));
  }
  return rule_->start(given, clocks_);
}

Decision ClockPolicy::decide(const Observation& seen) noexcept {
  in_force_hz_ = clock_hz(seen);
  Decision wish = fixed_;
  wish.set(knob, in_force_hz_);
  return wish;
}

double ClockPolicy::clock_hz(const Observation& seen) noexcept {
  const bool is_first = !last_;
  const double elapsed_s = is_first ? 0.0 : to_seconds(seen.now - *last_);
  last_ = seen.now;
  const double granted_hz = seen.frequency.value();
  // What was granted counts, if the platform says anything of sense.
  const double clock_hz =
      std::isfinite(granted_hz) && granted_hz > 0.0 ? clocks_.nearest_hz(granted_hz) : in_force_hz_;
  if (rule_->samples() && elapsed_s <= 0.0) {
    return clock_hz;  // nothing has been sampled yet
  }
  const double load = std::isfinite(seen.busiest_core_load) ? seen.busiest_core_load : 0.0;
  return rule_->next_hz({seen.now, elapsed_s, std::clamp(load, 0.0, 1.0), clock_hz, clocks_});
}

}  // namespace flyball
