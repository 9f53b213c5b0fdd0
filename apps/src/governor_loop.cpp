// SPDX-License-Identifier: BSD-3-Clause
#include "governor_loop.h"

#include <cstdio>

namespace flyball {
namespace {

// The neighbourhood that the two-level switch looks at: the delivery camera's 7 m less a frame's
// travel, and a band of heights just wider than the body. A wider one would reach the ground's own
// cells: at .80 m, depth noise marks all of [0, .80).
constexpr double density_radius_m = 6.0;
constexpr double density_half_band_m = 0.3;
constexpr double nearest_limit_m = 20.0;

}  // namespace

GovernorLoop::GovernorLoop(MissionContext& context,
                           PolicyGovernor& governor,
                           VirtualExecutor& executor,
                           const ClosedLoop& loop,
                           const Navigator* navigator)
    : context_{context},
      governor_{governor},
      executor_{executor},
      loop_{loop},
      navigator_{navigator} {}

void GovernorLoop::tick(MissionTime now) {
  const Observation seen = observe(now);
  record(seen);
  const Decision decision = governor_.decide(seen);
  apply(now, decision);
  ++decisions_;
}

void GovernorLoop::record(const Observation& seen) {
  context_.recorder.record(
      seen.now, "observation",
      {{"speed_m_s", seen.speed_m_s},
       {"known_free_m", seen.known_free_m},
       {"obstacle_density", seen.obstacle_density},
       {"nearest_obstacle_m", seen.nearest_obstacle_m},
       {"distance_to_goal_m", seen.distance_to_goal_m},
       {"latency_s", to_seconds(seen.latency)},
       {"latency_bound_s", to_seconds(seen.latency_bound)},
       {"busy_cores", seen.busy_cores},
       {"deadline_misses", static_cast<std::int64_t>(seen.deadline_misses)},
       {"queue_drops", static_cast<std::int64_t>(seen.queue_drops)},
       {"planner_failures", static_cast<std::int64_t>(seen.planner_failures)}});
}

Observation GovernorLoop::observe(MissionTime now) {
  Observation seen;
  seen.now = now;
  seen.phase = context_.phase;
  seen.planner_failures = static_cast<std::uint32_t>(context_.counters.planner_failures_in_row);
  seen.map_resolution_m = context_.map().resolution_m();
  if (navigator_ != nullptr) {
    const Vec3 p_W = navigator_->follower().position_W();
    seen.speed_m_s = navigator_->follower().speed_m_s();
    seen.known_free_m = navigator_->follower().known_free_m();
    seen.tracking_error_m = navigator_->tracking_error().size_m;
    seen.distance_to_goal_m = (context_.goal_now_W - p_W).norm();
    seen.latency = navigator_->newest_latency();
    seen.latency_bound = navigator_->follower().latency_bound();
    seen.obstacle_density =
        context_.map().obstacle_density(p_W, density_radius_m, density_half_band_m);
    seen.nearest_obstacle_m =
        context_.map().nearest_obstacle_m(p_W, nearest_limit_m, density_half_band_m);
  }
  observe_computer(now, seen);
  return seen;
}

void GovernorLoop::observe_computer(MissionTime now, Observation& seen) {
  const double busy_core_s = executor_.busy_core_s();
  const double elapsed_s = to_seconds(now - last_);
  seen.busy_cores = elapsed_s > 0.0 ? (busy_core_s - last_busy_core_s_) / elapsed_s : 0.0;
  last_busy_core_s_ = busy_core_s;
  last_ = now;
  seen.deadline_misses = misses_;
  misses_ = 0;
  const std::uint64_t drops = executor_.drops();
  seen.queue_drops = static_cast<std::uint32_t>(drops - last_drops_);
  last_drops_ = drops;
  seen.cores = executor_.operating_point().cores;
  seen.frequency = executor_.operating_point().frequency;
  seen.computer_power = Watts{loop_.log().computer_w};
  seen.rotor_power = Watts{loop_.log().rotor_w};
  seen.battery_percent = loop_.battery().percent();
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
  if (governor_.last_fault() != PolicyFault::none) {
    ++faults_;
    context_.event(now, "policy fault: " + std::string{to_string(governor_.last_fault())});
  }
  const OperatingPoint wished{static_cast<int>(context_.knobs.value("cpu.cores")),
                              Hertz{context_.knobs.value("cpu.frequency_hz")}};
  if (wished != executor_.operating_point()) {
    executor_.set_operating_point(wished);
  }
}

}  // namespace flyball
