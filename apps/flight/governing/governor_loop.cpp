// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/governing/governor_loop.h"

#include "flyball/flight/navigation/gap_scan.h"
#include "flyball/runtime/observation_fields.h"

#include <algorithm>
#include <cstdio>

namespace flyball {
namespace {

// The neighbourhood that the two-level switch looks at: the delivery camera's 7 m less a frame's
// travel, and a band of heights just wider than the body. A wider one would reach the ground's own
// cells: at .80 m, depth noise marks all of [0, .80).
constexpr double density_radius_m = 6.0;
constexpr double density_half_band_m = 0.3;
constexpr double nearest_limit_m = 20.0;
constexpr double path_width_reach_m = 8.0;  // A little farther than the finest cells show.

/// On the path, or its end.
Vec3 place_ahead_W(const PathFollower& follower, double ahead_m) {
  const Path& path = follower.path();
  return path.at(std::min(follower.s_m() + ahead_m, path.length_m())).p_W;
}

}  // namespace

GovernorLoop::GovernorLoop(MissionContext& context,
                           PolicyGovernor& governor,
                           Board& board,
                           const Navigator* navigator,
                           ForesightSource* future)
    : context_{context},
      governor_{governor},
      board_{board},
      navigator_{navigator},
      future_{future},
      asked_{board.read().granted} {}

void GovernorLoop::tick(MissionTime now) {
  seen_.now = now;
  observe_computer(now);
  const bool looks = now >= next_look_;
  if (looks) {
    next_look_ = now + from_seconds(context_.settings.governor.period_s);
    observe_surroundings();
  }
  if (looks && future_ != nullptr) {
    governor_.foretell(future_->look(navigator_->follower()));
  }
  record(looks);
  const HostTime asked = HostTime::clock::now();
  const Decision decision = governor_.decide(seen_);
  decision_host_us_.push_back(
      std::chrono::duration<double, std::micro>(HostTime::clock::now() - asked).count());
  if (choices_.is_new(governor_, decision)) {
    context_.recorder.record(now, "choice", {{"what", choice_text(governor_, decision)}});
  }
  if (const std::string_view said = governor_.remark(); !said.empty()) {
    context_.event(now, "policy says: " + std::string{said});
  }
  record_promises(now);
  apply(now, decision);
  ++decisions_;
}

void GovernorLoop::record_promises(MissionTime now) {
  const std::optional<PromiseCount> count = governor_.policy().promises();
  if (count && count->issued != promises_) {
    promises_ = count->issued;
    context_.recorder.record(now, "promise",
                             {{"issued", static_cast<std::int64_t>(count->issued)},
                              {"late", static_cast<std::int64_t>(count->late)},
                              {"factor", count->factor}});
  }
}

/// Whole when it has looked around; else what has changed since, so that fast policies do not fill
/// the record. Together they are every observation, bit for bit.
void GovernorLoop::record(bool is_whole) {
  const auto& fields = observation_fields();
  told_.resize(fields.size());
  std::vector<Field> row;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double value = fields[i].get(seen_);
    const bool is_new = !have_same_bits(value, told_[i]);
    if (is_new || (is_whole && !fields[i].is_optional)) {
      row.push_back({fields[i].name, value});
      told_[i] = value;
    }
  }
  if (!row.empty()) {
    context_.recorder.record(seen_.now, is_whole ? "observation" : "computer", row);
  }
}

void GovernorLoop::observe_surroundings() {
  seen_.phase = context_.phase;
  seen_.planner_failures = static_cast<std::uint32_t>(context_.counters.planner_failures_in_row);
  seen_.map_resolution_m = context_.map().resolution_m();
  if (navigator_ == nullptr) {
    return;
  }
  const PathFollower& follower = navigator_->follower();
  const Vec3 p_W = follower.position_W();
  seen_.speed_m_s = follower.speed_m_s();
  seen_.speed_limit_m_s = speed_limit_ahead();
  seen_.max_deceleration_m_s2 = context_.settings.mission.max_acceleration_m_s2;
  seen_.known_free_m = follower.known_free_m();
  seen_.tracking_error_m = navigator_->tracking_error().size_m;
  seen_.distance_to_goal_m = (context_.goal_now_W - p_W).norm();
  seen_.latency = navigator_->newest_latency();
  seen_.latency_bound = follower.latency_bound();
  seen_.map_revision = navigator_->map_revision();
  seen_.map_age = seen_.map_revision > 0 ? seen_.now - navigator_->newest_capture() : Duration{};
  seen_.obstacle_density =
      context_.map().obstacle_density(p_W, density_radius_m, density_half_band_m);
  seen_.density_ahead = density_ahead();
  observe_gaps();
  seen_.nearest_obstacle_m =
      context_.map().nearest_obstacle_m(p_W, nearest_limit_m, density_half_band_m);
}

double GovernorLoop::speed_limit_ahead() const {
  const PathFollower& follower = navigator_->follower();
  double least = context_.speed_limit_m_s(follower.position_W());
  if (follower.has_path()) {
    for (const double ahead_m : {4.0, 8.0, 12.0, 16.0, 20.0}) {
      least = std::min(least, context_.speed_limit_m_s(place_ahead_W(follower, ahead_m)));
    }
  }
  return least;
}

double GovernorLoop::density_ahead() const {
  const PathFollower& follower = navigator_->follower();
  double most = 0.0;
  if (follower.has_path()) {
    for (const double ahead_m : {4.0, 8.0, 12.0}) {
      const Vec3 p_W = place_ahead_W(follower, ahead_m);
      most = std::max(most,
                      context_.map().obstacle_density(p_W, density_radius_m, density_half_band_m));
    }
  }
  return most;
}

void GovernorLoop::observe_gaps() {
  GapScan scan;
  scan.half_band_m = density_half_band_m;
  scan.bounds_W = context_.brief.bounds_W;
  const GapsAhead gaps =
      gaps_ahead(context_.map(), navigator_->follower().position_W(), context_.goal_now_W, scan);
  seen_.narrowest_gap_m = gaps.narrowest_m;
  seen_.gap_distance_m = gaps.narrowest_at_m;
  seen_.mean_gap_m = gaps.mean_m;
  const PathFollower& follower = navigator_->follower();
  if (follower.has_path()) {
    const PathSpan ahead{&follower.path(), follower.s_m(), path_width_reach_m};
    const PathWidth path = narrowest_on(context_.map(), ahead, density_half_band_m);
    if (path.width_m < seen_.narrowest_gap_m) {
      seen_.narrowest_gap_m = path.width_m;
      seen_.gap_distance_m = path.at_m;
    }
  }
}

void GovernorLoop::observe_computer(MissionTime now) {
  const BoardReading board = board_.read();
  const double elapsed_s = to_seconds(now - last_);
  seen_.busy_cores = elapsed_s > 0.0 ? (board.busy_core_s - last_busy_core_s_) / elapsed_s : 0.0;
  seen_.busiest_core_load =
      elapsed_s > 0.0 ? std::min(1.0, (board.busiest_core_s - last_busiest_core_s_) / elapsed_s)
                      : 0.0;
  last_busy_core_s_ = board.busy_core_s;
  last_busiest_core_s_ = board.busiest_core_s;
  last_ = now;
  seen_.deadline_misses = misses_;
  misses_ = 0;
  seen_.queue_drops = static_cast<std::uint32_t>(board.drops - last_drops_);
  last_drops_ = board.drops;
  context_.computer = board.granted;
  seen_.cores = board.granted.cores;
  seen_.frequency = board.granted.frequency;
  seen_.computer_power = board.computer_power;
  seen_.rotor_power = board.rotor_power;
  seen_.battery_percent = board.battery_percent;
  seen_.temperature_c = board.temperature_c;
  seen_.trip_c = board.trip_c;
}

/// Once for each knob whose wished value this mission does not have: a mapper may know no cells of
/// .8 m.
void GovernorLoop::note_moved_wishes(MissionTime now) {
  for (const auto& wish : governor_.wished()) {
    const KnobSpec* spec = context_.knobs.spec(wish.knob);
    if (spec == nullptr || spec->is_legal(wish.value) || !moved_.insert(spec->name).second) {
      continue;
    }
    char text[96];
    std::snprintf(text, sizeof text, "%s %g is not legal here, %g instead", spec->name.c_str(),
                  wish.value, spec->nearest(wish.value));
    context_.event(now, text);
  }
}

/// Each step of the ladder, up or down, is an event; so is each other fault of the policy.
void GovernorLoop::note_fallback(MissionTime now) {
  context_.restraint = {governor_.bound_factor(), governor_.must_hover()};
  const bool is_fault = governor_.last_fault() != PolicyFault::none;
  faults_ += is_fault ? 1 : 0;
  const Fallback fallback = governor_.fallback();
  if (fallback == fallback_ && fallback == Fallback::none) {
    return;
  }
  const std::string why = governor_.why();
  if (is_fault && trouble_.empty()) {
    trouble_ = why;
  }
  if (fallback != fallback_ || why != why_) {
    context_.event(
        now, "fallback " + std::string{to_string(fallback)} + (why.empty() ? "" : ": " + why));
  }
  fallback_ = fallback;
  why_ = why;
}

void GovernorLoop::apply(MissionTime now, const Decision& decision) {
  note_moved_wishes(now);
  for (const auto& wish : decision) {
    const double before = context_.knobs.value(wish.knob);
    if (before == wish.value || !context_.knobs.set(wish.knob, wish.value)) {
      continue;
    }
    ++knob_changes_;
    context_.recorder.record(now, "decision",
                             {{"knob", std::string{wish.knob}},
                              {"value", wish.value},
                              {"before", before},
                              {"reason", std::string{to_string(decision.reason)}}});
  }
  note_fallback(now);
  const OperatingPoint wished{static_cast<int>(context_.knobs.value("cpu.cores")),
                              Hertz{context_.knobs.value("cpu.frequency_hz")}};
  if (wished != asked_) {  // What is granted may be less.
    asked_ = wished;
    board_.request(wished);
    context_.computer = board_.read().granted;
  }
}

}  // namespace flyball
