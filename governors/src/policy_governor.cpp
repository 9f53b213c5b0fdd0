// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/policy_governor.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <utility>

namespace flyball {
namespace {

constexpr std::string_view clock_knob = "cpu.frequency_hz";
constexpr std::string_view cores_knob = "cpu.cores";

/// One after the other, cut off where `text` is full. @pre `size > 0`.
void join(std::initializer_list<std::string_view> parts, char* text, std::size_t size) noexcept {
  std::size_t used = 0;
  for (const std::string_view part : parts) {
    const std::size_t fitting = std::min(part.size(), size - 1 - used);
    std::copy_n(part.data(), fitting, text + used);
    used += fitting;
  }
  text[used] = '\0';
}

}  // namespace

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
    case PolicyFault::failed:
      return "failed";
  }
  return "none";
}

PolicyGovernor::PolicyGovernor(std::unique_ptr<Policy> policy,
                               KnobSettings knobs,
                               PolicyGovernorSettings settings,
                               HostClock clock)
    : policy_{std::move(policy)},
      chooses_period_{dynamic_cast<const ChoosesPeriod*>(policy_.get())},
      bounds_latency_{dynamic_cast<const BoundsLatency*>(policy_.get())},
      compares_options_{dynamic_cast<const ComparesOptions*>(policy_.get())},
      hosts_code_{dynamic_cast<const HostsCode*>(policy_.get())},
      knobs_{std::move(knobs)},
      settings_{settings},
      clock_{std::move(clock)},
      changed_(knobs_.specs().size()),
      ladder_{settings_.fallback} {
  FLYBALL_ASSERT(policy_ != nullptr, "a governor needs a policy");
  FLYBALL_ASSERT(knobs_.specs().size() <= Decision::capacity, "%zu knobs, a decision holds %zu",
                 knobs_.specs().size(), Decision::capacity);
  FLYBALL_ASSERT(settings_.min_dwell.count() >= 0 && settings_.max_faults >= 1,
                 "min_dwell=%g s, max_faults=%d", to_seconds(settings_.min_dwell),
                 settings_.max_faults);
  for (const KnobSpec& spec : knobs_.specs()) {
    in_force_.push_back(knobs_.value(spec.name));
    defaults_.push_back(spec.fallback);
    const bool is_platform = spec.name == clock_knob || spec.name == cores_knob;
    table_.push_back(is_platform ? spec.nearest(std::numeric_limits<double>::max())
                                 : spec.fallback);
  }
}

Decision PolicyGovernor::decide(const Observation& seen) noexcept {
  wished_ = {};
  was_asked_ = false;
  fallback_ = ladder_.look(seen, requested());
  if (fallback_ == Fallback::table || fallback_ == Fallback::hover) {
    last_fault_ = has_fallen_back() ? last_fault_ : PolicyFault::none;
    // The policy is not asked: what it would learn from this is wrong.
    return put_all_in_force(seen.now, table_);
  }
  if (!has_fallen_back()) {
    last_fault_ = PolicyFault::none;
    was_asked_ = true;
    const Decision wished = ask(seen, last_fault_);
    if (last_fault_ == PolicyFault::none) {
      faults_in_row_ = 0;
      wished_ = wished;
      return made_legal(wished, seen.now);
    }
    ++faults_in_row_;
  }
  fallback_ = Fallback::safe_static;
  return put_all_in_force(seen.now, defaults_);
}

std::string PolicyGovernor::why() const {
  if (fallback_ == Fallback::safe_static && was_asked_ && last_fault_ == PolicyFault::failed) {
    return std::string{hosts_code_->trouble()};  // Of any length.
  }
  std::array<char, 1024> text{};  // Knobs that scripts name have at most 512 bytes.
  write_why(text.data(), text.size());
  return text.data();
}

void PolicyGovernor::write_why(char* text, std::size_t size) const noexcept {
  if (fallback_ != Fallback::safe_static) {
    return join({ladder_.why()}, text, size);
  }
  if (!was_asked_) {
    std::snprintf(text, size, "the policy failed %d times in a row and is not asked any more",
                  settings_.max_faults);
    return;
  }
  switch (last_fault_) {
    case PolicyFault::none:
      return join({}, text, size);
    case PolicyFault::failed:
      return join({hosts_code_->trouble()}, text, size);
    case PolicyFault::overtime:
      std::snprintf(text, size, "the policy took longer than %f s",
                    to_seconds(settings_.time_limit));
      return;
    case PolicyFault::overflow:
      return join({"the policy wishes more than a decision holds"}, text, size);
    case PolicyFault::unknown_knob:
      return join({"the policy wishes for a knob that does not exist: \"", faulty_knob_, "\""},
                  text, size);
    case PolicyFault::not_finite:
      return join({"the policy's wish for ", faulty_knob_, " is not a finite number"}, text, size);
  }
}

std::string_view PolicyGovernor::remark() const {
  return was_asked_ && hosts_code_ != nullptr ? hosts_code_->remark() : std::string_view{};
}

std::optional<Duration> PolicyGovernor::period() const {
  return chooses_period_ != nullptr ? chooses_period_->period() : std::nullopt;
}

std::optional<BoundCount> PolicyGovernor::bounds() const noexcept {
  return bounds_latency_ != nullptr ? std::optional{bounds_latency_->bounds()} : std::nullopt;
}

std::vector<LevelBounds> PolicyGovernor::bound_levels() const {
  return bounds_latency_ != nullptr ? bounds_latency_->bound_levels() : std::vector<LevelBounds>{};
}

std::vector<PolicyOption> PolicyGovernor::options() const {
  return compares_options_ != nullptr ? compares_options_->options() : std::vector<PolicyOption>{};
}

double PolicyGovernor::bound_factor() const {
  // The safe default is as safe as it is without a policy.
  const bool is_usual = fallback_ == Fallback::none || fallback_ == Fallback::safe_static;
  return is_usual ? 1.0 : settings_.fallback.bound_factor;
}

Decision PolicyGovernor::ask(const Observation& seen, PolicyFault& fault) noexcept {
  const HostTime before = clock_ ? clock_() : HostTime{};
  const Decision wished = policy_->decide(seen);
  const bool is_late = clock_ && clock_() - before > settings_.time_limit;
  fault = is_late ? PolicyFault::overtime : fault_in(wished);
  return wished;
}

PolicyFault PolicyGovernor::fault_in(const Decision& wished) noexcept {
  if (hosts_code_ != nullptr && !hosts_code_->trouble().empty()) {
    return PolicyFault::failed;
  }
  if (wished.overflowed()) {
    return PolicyFault::overflow;
  }
  for (const auto& [knob, value] : wished) {
    faulty_knob_ = knob;
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
    if (leader_changes(spec.follows, wished, now).value_or(may_change(knob, now))) {
      put_in_force(knob, spec.nearest(value), now);
    }
    answer.set(spec.name, in_force_[knob]);
  }
  return answer;
}

Decision PolicyGovernor::put_all_in_force(MissionTime now,
                                          const std::vector<double>& values) noexcept {
  Decision answer;
  answer.reason = Reason::fallback;
  for (std::size_t knob = 0; knob < in_force_.size(); ++knob) {
    put_in_force(knob, values[knob], now);
    answer.set(knobs_.specs()[knob].name, values[knob]);
  }
  return answer;
}

FallbackLadder::Request PolicyGovernor::requested() const noexcept {
  FallbackLadder::Request request;
  const std::size_t clock = index_of(clock_knob);
  const std::size_t cores = index_of(cores_knob);
  if (clock < in_force_.size()) {
    request.frequency_hz = in_force_[clock];
  }
  if (cores < in_force_.size()) {
    request.cores = in_force_[cores];
  }
  return request;
}

bool PolicyGovernor::may_change(std::size_t knob, MissionTime now) const noexcept {
  const Duration dwell = knobs_.specs()[knob].min_dwell.value_or(settings_.min_dwell);
  return !changed_[knob] || now - *changed_[knob] >= dwell;
}

/// Whether a knob that others follow changes in this decision; empty: nobody wishes that.
std::optional<bool> PolicyGovernor::leader_changes(std::string_view leader,
                                                   const Decision& wished,
                                                   MissionTime now) const noexcept {
  const auto wish = std::find_if(wished.begin(), wished.end(), [leader](const Decision::Wish& one) {
    return one.knob == leader;
  });
  if (wish == wished.end()) {
    return std::nullopt;
  }
  const std::size_t knob = index_of(leader);
  if (changed_[knob] == now) {  // Its wish came first.
    return true;
  }
  const bool is_new = knobs_.specs()[knob].nearest(wish->value) != in_force_[knob];
  return is_new ? std::optional{may_change(knob, now)} : std::nullopt;
}

void PolicyGovernor::put_in_force(std::size_t knob, double value, MissionTime now) noexcept {
  if (in_force_[knob] != value) {
    in_force_[knob] = value;
    changed_[knob] = now;
  }
}

}  // namespace flyball
