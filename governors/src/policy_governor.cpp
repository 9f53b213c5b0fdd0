// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/policy_governor.h"

#include "flyball/runtime/assert.h"

#include <cmath>
#include <utility>

namespace flyball {

std::string_view to_string(PolicyFault fault) {
  switch (fault) {
    case PolicyFault::none:
      return "none";
    case PolicyFault::unknown_knob:
      return "unknown_knob";
    case PolicyFault::not_finite:
      return "not_finite";
    case PolicyFault::overflow:
      return "overflow";
    case PolicyFault::overtime:
      return "overtime";
  }
  return "none";
}

PolicyGovernor::PolicyGovernor(std::unique_ptr<Policy> policy,
                               KnobSettings knobs,
                               PolicyGovernorSettings settings,
                               HostClock clock)
    : policy_{std::move(policy)},
      knobs_{std::move(knobs)},
      settings_{settings},
      clock_{std::move(clock)},
      changed_(knobs_.specs().size()) {
  FLYBALL_ASSERT(policy_ != nullptr, "a governor needs a policy");
  FLYBALL_ASSERT(knobs_.specs().size() <= Decision::capacity, "%zu knobs, a decision holds %zu",
                 knobs_.specs().size(), Decision::capacity);
  FLYBALL_ASSERT(settings_.min_dwell.count() >= 0 && settings_.max_faults >= 1,
                 "min_dwell=%g s, max_faults=%d", to_seconds(settings_.min_dwell),
                 settings_.max_faults);
  for (const KnobSpec& spec : knobs_.specs()) {
    in_force_.push_back(knobs_.value(spec.name));
  }
}

Decision PolicyGovernor::decide(const Observation& seen) noexcept {
  wished_ = {};
  if (has_fallen_back()) {
    return safe_default(seen.now);
  }
  last_fault_ = PolicyFault::none;
  const Decision wished = ask(seen, last_fault_);
  if (last_fault_ != PolicyFault::none) {
    ++faults_in_row_;
    return safe_default(seen.now);
  }
  faults_in_row_ = 0;
  wished_ = wished;
  return made_legal(wished, seen.now);
}

Decision PolicyGovernor::ask(const Observation& seen, PolicyFault& fault) noexcept {
  const HostTime before = clock_ ? clock_() : HostTime{};
  const Decision wished = policy_->decide(seen);
  const bool is_late = clock_ && clock_() - before > settings_.time_limit;
  fault = is_late ? PolicyFault::overtime : fault_in(wished);
  return wished;
}

PolicyFault PolicyGovernor::fault_in(const Decision& wished) const noexcept {
  if (wished.overflowed()) {
    return PolicyFault::overflow;
  }
  for (const auto& [knob, value] : wished) {
    if (index_of(knob) == in_force_.size()) {
      return PolicyFault::unknown_knob;
    }
    if (!std::isfinite(value)) {
      return PolicyFault::not_finite;
    }
  }
  return PolicyFault::none;
}

std::size_t PolicyGovernor::index_of(std::string_view knob) const noexcept {
  const auto& specs = knobs_.specs();
  std::size_t index = 0;
  while (index < specs.size() && specs[index].name != knob) {
    ++index;
  }
  return index;
}

Decision PolicyGovernor::made_legal(const Decision& wished, MissionTime now) noexcept {
  Decision answer;
  answer.reason = wished.reason;
  for (const auto& [name, value] : wished) {
    const std::size_t knob = index_of(name);
    const KnobSpec& spec = knobs_.specs()[knob];
    if (may_change(knob, now)) {
      put_in_force(knob, spec.nearest(value), now);
    }
    answer.set(spec.name, in_force_[knob]);
  }
  return answer;
}

Decision PolicyGovernor::safe_default(MissionTime now) noexcept {
  Decision answer;
  answer.reason = Reason::fallback;
  for (std::size_t knob = 0; knob < in_force_.size(); ++knob) {
    const KnobSpec& spec = knobs_.specs()[knob];
    put_in_force(knob, spec.fallback, now);
    answer.set(spec.name, spec.fallback);
  }
  return answer;
}

bool PolicyGovernor::may_change(std::size_t knob, MissionTime now) const noexcept {
  const Duration dwell = knobs_.specs()[knob].min_dwell.value_or(settings_.min_dwell);
  return !changed_[knob] || now - *changed_[knob] >= dwell;
}

void PolicyGovernor::put_in_force(std::size_t knob, double value, MissionTime now) noexcept {
  if (in_force_[knob] != value) {
    in_force_[knob] = value;
    changed_[knob] = now;
  }
}

}  // namespace flyball
