// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_signals
#include "observed_signals.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// Whether a member took a value as it is, but for a nanosecond: a phase of 7 does not exist, and
/// nobody has 2.5 cores.
bool took(double given, double taken) {
  return std::abs(given - taken) <= 1e-9 * std::max(1.0, std::abs(given));
}

}  // namespace

ObservedSignals::ObservedSignals()
    : fields_{observation_fields()}, states_(observation_fields().size()) {}

std::optional<std::size_t> ObservedSignals::index(std::string_view name) const {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (fields_[i].name == name) {
      return i;
    }
  }
  return std::nullopt;
}

bool ObservedSignals::observe(std::size_t signal, double value) {
  State& state = states_[signal];
  Observation probe = seen_;
  const bool is_possible = std::isfinite(value) && [&] {
    fields_[signal].set(probe, value);
    return took(value, fields_[signal].get(probe));
  }();
  state.is_refused = !is_possible;
  if (is_possible) {
    seen_ = probe;
    state.is_known = true;
    state.is_callers = true;
  }
  return is_possible;
}

void ObservedSignals::derive(std::string_view name, double value) {
  const auto signal = index(name);
  FLYBALL_ASSERT(signal.has_value(), "no signal %.*s", static_cast<int>(name.size()), name.data());
  if (State& state = states_[*signal]; !state.is_callers) {
    fields_[*signal].set(seen_, value);
    state.is_known = true;
    state.is_refused = false;
  }
}

bool ObservedSignals::is_callers(std::string_view name) const {
  const auto signal = index(name);
  return signal && states_[*signal].is_callers;
}

double ObservedSignals::value(std::size_t signal) const {
  return states_[signal].is_known ? fields_[signal].get(seen_) : 0.0;
}

Observation ObservedSignals::seen(MissionTime now) const {
  Observation all = seen_;
  all.now = now;
  return all;
}

const char* ObservedSignals::refused() const {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (states_[i].is_refused) {
      return fields_[i].name;
    }
  }
  return nullptr;
}

void ObservedSignals::begin_counts_anew() {
  seen_.deadline_misses = 0;
  seen_.queue_drops = 0;
}

}  // namespace flyball
