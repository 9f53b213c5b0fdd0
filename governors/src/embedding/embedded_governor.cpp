// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_decisions
#include "embedded_governor.h"

#include "decision_line.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

using flyball::Duration;
using flyball::MissionTime;
using flyball::Observation;

namespace {

/// As an observation that no governor believes, whatever else it says.
Observation unbelievable(Observation seen) {
  seen.speed_m_s = std::numeric_limits<double>::quiet_NaN();
  return seen;
}

}  // namespace

std::int32_t FlyballGovernor::check_open(const char* what) {
  if (!governor_) {
    return error_.set(flyball_governor_invalid_input, "%s: call flyball_governor_open first", what);
  }
  if (is_calling_back_) {
    return error_.set(flyball_governor_invalid_input,
                      "%s: a callback may call flyball_governor_granted and nothing else", what);
  }
  return flyball_governor_ok;
}

std::int32_t FlyballGovernor::advance(double now_s) {
  const Duration now = flyball::nearest_duration(now_s);
  if (!std::isfinite(now_s) || now >= flyball::longest_duration ||
      now <= -flyball::longest_duration) {
    return error_.set(flyball_governor_invalid_input, "the time cannot be %g s", now_s);
  }
  if (now < Duration::zero()) {  // To policies 0 is long ago.
    return error_.set(flyball_governor_invalid_input,
                      "the time cannot be %g s; count it from a moment before the first call",
                      now_s);
  }
  if (now_ && MissionTime{now} < *now_) {
    return error_.set(flyball_governor_invalid_input,
                      "the time went back from %.9f s to %.9f s; a governor needs one clock",
                      flyball::to_seconds(*now_), now_s);
  }
  now_ = MissionTime{now};
  return flyball_governor_ok;
}

std::int32_t FlyballGovernor::check_stage(std::uint32_t stage) {
  return stage < stages_.size()
             ? std::int32_t{flyball_governor_ok}
             : error_.set(flyball_governor_not_found, "there is no stage %u; %zu were added", stage,
                          stages_.size());
}

std::int32_t FlyballGovernor::begin(std::uint32_t stage, double now_s) {
  if (const auto code = check_open("flyball_governor_begin")) {
    return code;
  }
  if (const auto code = check_stage(stage)) {
    return code;
  }
  if (const auto code = advance(now_s)) {
    return code;
  }
  stages_.begin(stage, *now_);
  return flyball_governor_ok;
}

std::int32_t FlyballGovernor::end(std::uint32_t stage,
                                  double now_s,
                                  const double* counts,
                                  std::uint32_t count) {
  if (const auto code = check_open("flyball_governor_end")) {
    return code;
  }
  if (const auto code = check_stage(stage)) {
    return code;
  }
  const flyball::StageSpec& spec = stages_.spec(stage);
  if (!stages_.has_begun(stage)) {
    return error_.set(flyball_governor_invalid_input, "stage \"%s\" ends, but it has not begun",
                      spec.name.c_str());
  }
  if (count != 0 && count != spec.work.size()) {
    return error_.set(flyball_governor_invalid_input, "stage \"%s\" counts %zu things, not %u",
                      spec.name.c_str(), spec.work.size(), count);
  }
  if (!std::all_of(counts, counts + count,
                   [](double one) { return std::isfinite(one) && one >= 0.0; })) {
    return error_.set(flyball_governor_invalid_input,
                      "stage \"%s\" has a count that is negative or not finite", spec.name.c_str());
  }
  if (const auto code = advance(now_s)) {
    return code;
  }
  if (const auto latency = stages_.end(stage, *now_, count > 0 ? counts : nullptr);
      latency && !signals_.is_callers("latency_s")) {
    add_frame(*latency);
    signals_.derive("latency_s", flyball::to_seconds(*latency));
  }
  return flyball_governor_ok;
}

void FlyballGovernor::add_frame(Duration latency) {
  latencies_.add(latency);
  ++frames_;
  signals_.derive("map_revision", static_cast<double>(frames_));
}

std::int32_t FlyballGovernor::observe(const char* signal, double value) {
  if (const auto code = check_open("flyball_governor_observe")) {
    return code;
  }
  const auto index = signal != nullptr ? signals_.index(signal) : std::nullopt;
  if (!index) {
    return error_.set(flyball_governor_not_found,
                      "there is no signal \"%s\"; flyball_governor_list has them all",
                      signal != nullptr ? signal : "NULL");
  }
  if (!signals_.observe(*index, value)) {
    return error_.set(flyball_governor_invalid_input, "signal %s cannot be %g", signal, value);
  }
  if (std::strcmp(signal, "latency_s") == 0 && value >= 0.0) {
    add_frame(flyball::nearest_duration(value));
  }
  return flyball_governor_ok;
}

std::int32_t FlyballGovernor::granted(const char* knob, double value) {
  if (!governor_) {
    return check_open("flyball_governor_granted");
  }
  const auto index = knob != nullptr ? knobs_.index(knob) : std::nullopt;
  if (!index) {
    return error_.set(flyball_governor_not_found, "there is no knob \"%s\"; it was never added",
                      knob != nullptr ? knob : "NULL");
  }
  if (!std::isfinite(value)) {
    return error_.set(flyball_governor_invalid_input, "knob \"%s\" cannot be granted as %g", knob,
                      value);
  }
  knobs_.grant(*index, value);
  return flyball_governor_ok;
}

Duration FlyballGovernor::latency_bound() const {
  const Duration callers = signals_.seen(*now_).latency_bound;  // May be negative.
  const Duration bound = signals_.is_callers("latency_bound_s")
                             ? std::max(callers, Duration::zero())
                             : latencies_.bound();
  return flyball::from_seconds(flyball::to_seconds(bound) * governor_->bound_factor());
}

void FlyballGovernor::observe_loop() {
  if (frames_ > 0 || latencies_.bound() > Duration::zero()) {
    signals_.derive("latency_bound_s", flyball::to_seconds(latency_bound()));
  }
  if (const auto captured = stages_.captured()) {
    signals_.derive("map_age_s", flyball::to_seconds(*now_ - *captured));
  }
  if (stages_.size() > 0) {
    const flyball::StageTimes::Load load = stages_.take_load(*now_);
    signals_.derive("busy_cores", load.busy_cores);
    signals_.derive("busiest_core_load", load.busiest_core);
    signals_.derive("deadline_misses", stages_.take_misses(*now_));
    observe_stages();
  }
}

/// Of stages with the names that policies know.
void FlyballGovernor::observe_stages() {
  constexpr std::array<std::array<const char*, 4>, 6> known{{
      {"map", "map_job_s", "map_load", "map_gigacycles"},
      {"plan", "plan_job_s", "plan_load", "plan_gigacycles"},
      {"detect", "detect_job_s", "detect_load", "detect_gigacycles"},
      {"track", "track_job_s", "track_load", "track_gigacycles"},
      {"localize", "localize_job_s", "localize_load", "localize_gigacycles"},
      {"explore", "explore_job_s", "explore_load", "explore_gigacycles"},
  }};
  const auto clock = knobs_.index("cpu.frequency_hz");
  const double ghz = clock ? knobs_.all()[*clock].in_force * 1e-9 : 0.0;
  for (const auto& [name, job_s, load, gigacycles] : known) {
    for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
      const auto last = stages_.duration(stage);
      if (last && stages_.spec(stage).name == name) {
        signals_.derive(job_s, flyball::to_seconds(*last));
        signals_.derive(load, stages_.load(stage));
        signals_.derive(gigacycles, flyball::to_seconds(*last) * ghz);
      }
    }
  }
}

void FlyballGovernor::observe_knobs() {
  constexpr std::array<std::pair<const char*, const char*>, 4> seen_as{
      {{"map.resolution_m", "map_resolution_m"},
       {"map.range_m", "map_range_m"},
       {"cpu.frequency_hz", "frequency_hz"},
       {"cpu.cores", "cores"}}};
  for (const auto& [knob, signal] : seen_as) {
    if (const auto index = knobs_.index(knob)) {
      signals_.derive(signal, knobs_.all()[*index].in_force);
    }
  }
}

std::int32_t FlyballGovernor::decide(double now_s) {
  if (const auto code = check_open("flyball_governor_decide")) {
    return code;
  }
  if (const auto code = advance(now_s)) {
    return code;
  }
  observe_loop();
  observe_knobs();
  const Observation seen = signals_.seen(*now_);
  const flyball::Decision decision =
      governor_->decide(signals_.refused() == nullptr ? seen : unbelievable(seen));
  is_calling_back_ = true;
  const flyball::CallersKnobs::Knob* failed = knobs_.put_in_force(decision);
  answer(decision, seen);
  const std::int32_t recorded = record(seen);
  is_calling_back_ = false;
  signals_.begin_counts_anew();
  return failed == nullptr
             ? recorded
             : error_.set(flyball_governor_failed,
                          "knob \"%s\" could not be set to %g %s; it is asked again at the next "
                          "decision",
                          failed->spec.name.c_str(), failed->decided, failed->spec.unit.c_str());
}

void FlyballGovernor::answer(const flyball::Decision& decision, const Observation& seen) {
  if (const char* refused = signals_.refused()) {
    std::snprintf(why_.data(), why_.size(),
                  "signal %s was observed with a value that it cannot have", refused);
  } else {
    governor_->write_why(why_.data(), why_.size());
  }
  answer_ = {};
  answer_.mode = static_cast<std::uint32_t>(knobs_.mode());
  answer_.knob_count = static_cast<std::uint32_t>(knobs_.all().size());
  answer_.must_hover = governor_->must_hover() ? 1U : 0U;
  answer_.reason = to_string(decision.reason).data();  // They are literals.
  answer_.fallback = to_string(governor_->fallback()).data();
  answer_.why = why_.data();
  answer_.latency_bound_s = flyball::to_seconds(latency_bound());
  answer_.safe_speed_m_s = safe_speed_m_s(seen);
  const auto period = governor_->period();
  answer_.next_s = period ? flyball::to_seconds(*period) : 0.0;
  for (std::size_t i = 0; i < knobs_.all().size(); ++i) {
    answer_.decided[i] = knobs_.all()[i].decided;
    answer_.in_force[i] = knobs_.all()[i].in_force;
  }
}

double FlyballGovernor::safe_speed_m_s(const Observation& seen) const {
  if (!(seen.max_deceleration_m_s2 > 0.0)) {
    return 0.0;
  }
  flyball::GuardSettings settings = guard_;
  settings.max_deceleration_m_s2 = seen.max_deceleration_m_s2;
  // A frame under way that is older than the bound will come no earlier than now.
  const Duration latency = std::max(latency_bound(), stages_.age_under_way(*now_));
  return flyball::Guard{settings}.cruise_speed(latency, seen.known_free_m);
}

std::int32_t FlyballGovernor::record(const Observation& seen) {
  if (settings_.record == nullptr) {
    return flyball_governor_ok;
  }
  flyball::write_decision_line(line_, answer_, knobs_, seen);
  try {
    settings_.record(settings_.context, line_.data());
  } catch (...) {  // As with the knobs' callbacks; the line is lost.
    return error_.set(flyball_governor_failed, "the record's callback threw an exception");
  }
  return flyball_governor_ok;
}

std::int32_t FlyballGovernor::list(std::uint32_t number, FlyballGovernorEntry& entry) {
  const std::size_t signals = flyball::observation_fields().size();
  const std::size_t knobs = knobs_.all().size();
  if (number < signals) {
    entry = signal_entry(number);
  } else if (number < signals + knobs) {
    entry = knob_entry(number - signals);
  } else if (const auto found = stage_entry(number - signals - knobs)) {
    entry = *found;
  } else {
    return error_.set(flyball_governor_not_found, "the list has no entry %u", number);
  }
  return flyball_governor_ok;
}

FlyballGovernorEntry FlyballGovernor::signal_entry(std::size_t signal) const {
  const flyball::ObservationField& field = flyball::observation_fields()[signal];
  FlyballGovernorEntry entry{};
  entry.kind = flyball_governor_signal;
  entry.name = field.name;
  entry.unit = field.unit;
  entry.description = field.description;
  entry.value = signals_.value(signal);
  entry.is_known = signals_.is_known(signal) ? 1U : 0U;
  return entry;
}

FlyballGovernorEntry FlyballGovernor::knob_entry(std::size_t knob) const {
  const flyball::CallersKnobs::Knob& one = knobs_.all()[knob];
  FlyballGovernorEntry entry{};
  entry.kind = flyball_governor_knob;
  entry.name = one.spec.name.c_str();
  entry.unit = one.spec.unit.c_str();
  entry.description = one.spec.description.c_str();
  entry.value = one.in_force;
  entry.is_known = 1U;
  entry.legal_count = static_cast<std::uint32_t>(one.spec.legal.size());
  entry.legal = one.spec.legal.empty() ? nullptr : one.spec.legal.data();
  entry.min = one.spec.min;
  entry.max = one.spec.max;
  return entry;
}

/// Of each stage its duration, then its counts.
std::optional<FlyballGovernorEntry> FlyballGovernor::stage_entry(std::size_t number) const {
  for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
    const std::size_t measures = 1 + stages_.spec(stage).work.size();
    if (number < measures) {
      return measure_entry(stage, number);
    }
    number -= measures;
  }
  return std::nullopt;
}

FlyballGovernorEntry FlyballGovernor::measure_entry(std::size_t stage, std::size_t number) const {
  const flyball::StageSpec& spec = stages_.spec(stage);
  const bool is_duration = number == 0;
  const auto& measure = is_duration ? spec.duration : spec.work[number - 1];
  FlyballGovernorEntry entry{};
  entry.kind = is_duration ? flyball_governor_duration : flyball_governor_work;
  entry.name = measure.name.c_str();
  entry.unit = is_duration ? "s" : "1";
  entry.description = measure.description.c_str();
  if (const auto last = stages_.duration(stage)) {
    entry.is_known = 1U;
    entry.value = is_duration ? flyball::to_seconds(*last) : stages_.count(stage, number - 1);
  }
  return entry;
}
