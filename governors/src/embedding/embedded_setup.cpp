// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_bad_input
#include "embedded_governor.h"
#include "embedded_policy.h"
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

using flyball::Done;
using flyball::Error;
using flyball::ErrorCode;
using flyball::KnobMode;

namespace {

std::int32_t code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_input:
      return flyball_governor_invalid_input;
    case ErrorCode::not_found:
      return flyball_governor_not_found;
    case ErrorCode::failed:
      return flyball_governor_failed;
    case ErrorCode::unavailable:
      return flyball_governor_unavailable;
  }
  return flyball_governor_failed;
}

bool is_switched_on(const char* variable) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): it is read once, while the caller sets his program up
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' && std::strcmp(value, "0") != 0;
}

KnobMode mode_of_environment() {
  const bool is_dry = is_switched_on("FLYBALL_DRY_RUN");
  return is_switched_on("FLYBALL_SHADOW") ? KnobMode::shadow
         : is_dry                         ? KnobMode::dry_run
                                          : KnobMode::governing;
}

/// Where nobody applies what is asked for, its absence is no fault of the computer.
flyball::PolicyGovernorSettings governor_settings(double min_dwell_s, KnobMode mode) {
  flyball::PolicyGovernorSettings settings;
  if (min_dwell_s > 0.0) {
    settings.min_dwell = flyball::from_seconds(min_dwell_s);
  }
  if (mode != KnobMode::governing) {
    settings.fallback.mismatch_patience = flyball::longest_duration;
  }
  return settings;
}

/// The caller's own reaction time stands for all of the guard's parts.
flyball::GuardSettings guard_settings(double reaction_s) {
  flyball::GuardSettings guard;
  if (reaction_s > 0.0) {
    guard.tick = guard.command_age = {};
    guard.brake_lag = flyball::from_seconds(reaction_s);
  }
  return guard;
}

bool is_time(double s) {
  return std::isfinite(s) && s >= 0.0;
}

/// What a stage can be called, with its counts.
flyball::Status check_texts(const FlyballGovernorStage& given) {
  if (flyball::Status named = flyball::check_name("a stage", given.name); !named) {
    return named;
  }
  if (given.work_count > 0 && given.work == nullptr) {
    return Error{ErrorCode::invalid_input, "stage \"" + std::string{given.name} + "\" counts " +
                                               std::to_string(given.work_count) +
                                               " things, but work is NULL"};
  }
  for (std::uint32_t i = 0; i < given.work_count; ++i) {
    if (flyball::Status named = flyball::check_name("what a stage counts", given.work[i]); !named) {
      return named;
    }
  }
  return Done{};
}

flyball::StageSpec spec_of(const FlyballGovernorStage& given) {
  flyball::StageSpec spec;
  spec.name = given.name;
  spec.duration = {spec.name + ".duration_s", "How long " + spec.name + " took last"};
  for (std::uint32_t i = 0; i < given.work_count; ++i) {
    const std::string work = given.work[i];
    spec.work.push_back({spec.name + "." + work, work + " that " + spec.name + " counted last"});
  }
  spec.deadline = flyball::from_seconds(given.deadline_s);
  spec.thread = given.thread;
  spec.is_beside = given.is_beside != 0;
  return spec;
}

}  // namespace

std::int32_t FlyballGovernor::refuse(const Error& error) {
  return error_.set(code_of(error.code), "%s", error.message.c_str());
}

std::int32_t FlyballGovernor::check_set_up(const char* what) {
  return governor_ ? error_.set(flyball_governor_invalid_input,
                                "%s: this governor is open already; call it before", what)
                   : flyball_governor_ok;
}

std::int32_t FlyballGovernor::add_knob(const FlyballGovernorKnob& given) {
  if (const auto code = check_set_up("flyball_governor_add_knob")) {
    return code;
  }
  const flyball::Status added = knobs_.add(given);
  return added ? std::int32_t{flyball_governor_ok} : refuse(added.error());
}

std::int32_t FlyballGovernor::add_stage(const FlyballGovernorStage& given) {
  if (const auto code = check_set_up("flyball_governor_add_stage")) {
    return code;
  }
  if (const flyball::Status texts = check_texts(given); !texts) {
    return refuse(texts.error());
  }
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (stages_.spec(i).name == given.name) {
      return error_.set(flyball_governor_invalid_input, "stage \"%s\" was added already",
                        given.name);
    }
  }
  if (!is_time(given.deadline_s)) {
    return error_.set(flyball_governor_invalid_input,
                      "stage \"%s\" needs a deadline_s that is finite and not negative",
                      given.name);
  }
  stages_.add(spec_of(given));
  return flyball_governor_ok;
}

std::int32_t FlyballGovernor::open(const FlyballGovernorSettings& settings) {
  if (const auto code = check_set_up("flyball_governor_open")) {
    return code;
  }
  if (knobs_.all().empty()) {
    return error_.set(flyball_governor_invalid_input,
                      "there is nothing to govern; call flyball_governor_add_knob first");
  }
  if (!is_time(settings.min_dwell_s) || !is_time(settings.first_latency_s) ||
      !is_time(settings.reaction_s)) {
    return error_.set(
        flyball_governor_invalid_input,
        "min_dwell_s, first_latency_s and reaction_s must be finite and not negative");
  }
  const flyball::KnobSettings knobs = knobs_.settings();
  guard_ = guard_settings(settings.reaction_s);
  auto policy = flyball::start_embedded_policy(settings, knobs, guard_.reaction_time());
  if (!policy) {
    return refuse(policy.error());
  }
  knobs_.set_mode(mode_of_environment());
  // Without a clock for the watchdog: time is the caller's.
  governor_.emplace(std::move(*policy), knobs,
                    governor_settings(settings.min_dwell_s, knobs_.mode()),
                    flyball::PolicyGovernor::HostClock{});
  settings_ = settings;
  latencies_ = flyball::LatencyWindow{flyball::from_seconds(settings.first_latency_s)};
  return flyball_governor_ok;
}
