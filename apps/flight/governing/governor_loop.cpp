// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/governing/governor_loop.h"

#include "flyball/flight/governing/surroundings.h"
#include "flyball/flight/navigation/gap_scan.h"
#include "flyball/flight/perception/counted_map.h"
#include "flyball/runtime/observation_fields.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace flyball {
namespace {

// Chosen: farther obstacles than this make no difference to any policy.
constexpr double nearest_limit_m = 20.0;
constexpr double path_width_reach_m = 8.0;  // A little farther than the delivery camera's range.
constexpr std::array<std::pair<const char*, Stage>, 8> stage_names{
    {{"map", Stage::map},
     {"plan", Stage::plan},
     {"detect", Stage::detect},
     {"track_buffered", Stage::track},
     {"track_real_time", Stage::track},
     {"see", Stage::localize},
     {"slam_load", Stage::localize},
     {"explore", Stage::explore}}};
constexpr int govern_priority = 90;  // The decision itself takes no time on the modeled computer.

}  // namespace

GovernorInputs governor_inputs(const Graph& graph) {
  GovernorInputs inputs;
  inputs.navigator = graph.find<NavigatorState>("navigator");
  for (std::size_t node = 0; node < graph.nodes().size(); ++node) {
    for (const auto& [name, stage] : stage_names) {
      if (graph.nodes()[node].spec.name == name) {
        inputs.stages[static_cast<std::size_t>(stage)].push_back(static_cast<int>(node));
      }
    }
  }
  return inputs;
}

GovernorLoop::GovernorLoop(const FlightParts& parts,
                           const KnobSettings& knobs,
                           PolicyGovernor& governor,
                           Board& board,
                           const GovernorInputs& inputs)
    : parts_{parts},
      knobs_{knobs_at_start(knobs)},
      governor_{governor},
      board_{board},
      inputs_{inputs},
      asked_{board.read().granted} {
  // Until there is a map, nothing is known to stand anywhere.
  const GapScan scan;
  seen_.nearest_obstacle_m = nearest_limit_m;
  seen_.narrowest_gap_m = seen_.mean_gap_m = 2.0 * scan.aside_m;
  seen_.gap_distance_m = scan.reach_m;
}

void GovernorLoop::note(JobContext& job, std::string_view channel, std::vector<Field> fields) {
  job.publish(parts_.mission.log, LogRow{seen_.now, channel, std::move(fields)});
}

void GovernorLoop::note_event(JobContext& job, const std::string& what) {
  note(job, "event", {{"what", what}});
}

Work GovernorLoop::tick(JobContext& job) {
  // When the decision is due, which is when it begins on a modeled computer, and a little earlier
  // on a real one: so the record says when each one was made.
  const MissionTime now = job.released();
  seen_.now = now;
  if (now != due_) {
    note(job, "governor",
         {{"period_s", to_seconds(inputs_.period)},
          {"decision", static_cast<std::int64_t>(decisions_)}});
  }
  due_ = now + inputs_.period;
  observe_computer(now);
  const bool looks = now >= next_look_;
  Work asked;
  if (looks) {
    next_look_ = now + from_seconds(parts_.brief->settings.governor.period_s);
    look_around(job, asked);
  }
  record(job, looks);
  decide(job);
  record_bounds(job);
  publish_knobs(job);
  return asked;
}

void GovernorLoop::decide(JobContext& job) {
  const HostTime asked = HostTime::clock::now();
  const Decision decision = governor_.decide(seen_);
  decision_host_us_.push_back(
      std::chrono::duration<double, std::micro>(HostTime::clock::now() - asked).count());
  if (choices_.is_new(governor_, decision)) {
    note(job, "choice", {{"what", choice_text(governor_, decision)}});
  }
  if (const std::string_view said = governor_.remark(); !said.empty()) {
    note_event(job, "policy says: " + std::string{said});
  }
  apply(job, decision);
  // A job that is killed when the flight ends publishes nothing, so no record has its decision.
  const bool is_fault = governor_.last_fault() != PolicyFault::none;
  job.at_end([this, is_fault](MissionTime) {
    ++decisions_;
    faults_ += is_fault ? 1 : 0;
  });
}

void GovernorLoop::publish_knobs(JobContext& job) {
  if (has_new_knobs_) {
    has_new_knobs_ = false;
    ++knobs_.version;
    job.publish(parts_.mission.knobs, knobs_);
  }
}

void GovernorLoop::record_bounds(JobContext& job) {
  const std::optional<BoundCount> count = governor_.bounds();
  if (count && count->issued != settled_bounds_) {
    settled_bounds_ = count->issued;
    note(job, "latency_bound",
         {{"issued", static_cast<std::int64_t>(count->issued)},
          {"late", static_cast<std::int64_t>(count->late)},
          {"factor", count->factor}});
  }
}

/// Records the whole observation after a look around, and otherwise only the fields that have
/// changed, so that policies that decide often do not fill the record. Together the rows give every
/// observation to the bit.
void GovernorLoop::record(JobContext& job, bool is_whole) {
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
    note(job, is_whole ? "observation" : "computer", std::move(row));
  }
}

void GovernorLoop::look_around(JobContext& job, Work& asked) {
  const auto state = job.latest(parts_.mission.state);
  seen_.phase = state ? state->phase : MissionPhase::wait;
  observe_progress(job);
  const auto navigator = inputs_.navigator ? job.latest(*inputs_.navigator) : nullptr;
  if (!navigator) {
    return;
  }
  observe_flight(*navigator);
  if (navigator->map) {
    const CountedMap counted{*navigator->map};
    observe_map(*navigator, counted);
    counted.add_to(asked);
  }
}

void GovernorLoop::observe_progress(JobContext& job) {
  if (const auto progress = job.latest(parts_.mission.progress)) {
    seen_.progress_unit = progress->unit;
    seen_.progress = progress->value;
    seen_.map_within = progress->map_within;
  }
}

void GovernorLoop::observe_flight(const NavigatorState& navigator) {
  seen_.planner_failures = static_cast<std::uint32_t>(navigator.planner_failures);
  seen_.speed_m_s = navigator.speed_m_s;
  seen_.speed_limit_m_s = speed_limit_ahead(navigator, knobs_, parts_.brief->site);
  seen_.slower_zone_m = slower_zone_m(navigator, knobs_, parts_.brief->site);
  seen_.max_deceleration_m_s2 = parts_.brief->settings.mission.max_acceleration_m_s2;
  seen_.known_free_m = navigator.known_free_m;
  seen_.tracking_error_m = navigator.tracking_error.size_m;
  seen_.distance_to_goal_m = (navigator.goal_W - navigator.position_W).norm();
  seen_.latency = navigator.map_latency;
  seen_.latency_bound = navigator.latency_bound;
  seen_.map_revision = navigator.map_revision;
  seen_.map_range_m = navigator.map_range_m;
  seen_.map_age = seen_.map_revision > 0 ? seen_.now - navigator.map_captured : Duration{};
}

void GovernorLoop::observe_map(const NavigatorState& navigator, const OccupancyView& map) {
  const Vec3& p_W = navigator.position_W;
  seen_.map_resolution_m = map.resolution_m();
  seen_.obstacle_density = map.obstacle_density(p_W, density_radius_m, density_half_band_m);
  seen_.density_ahead = density_ahead(navigator, map);
  observe_gaps(navigator, map);
  seen_.nearest_obstacle_m = map.nearest_obstacle_m(p_W, nearest_limit_m, density_half_band_m);
  seen_.headroom_m = headroom_m(p_W, parts_.brief->narrow_body(), map);
}

void GovernorLoop::observe_gaps(const NavigatorState& navigator, const OccupancyView& map) {
  GapScan scan;
  scan.half_band_m = density_half_band_m;
  scan.bounds_W = parts_.brief->site.bounds_W;
  const GapsAhead gaps = gaps_ahead(map, navigator.position_W, navigator.goal_W, scan);
  seen_.narrowest_gap_m = gaps.narrowest_m;
  seen_.gap_distance_m = gaps.narrowest_at_m;
  seen_.mean_gap_m = gaps.mean_m;
  if (navigator.has_path()) {
    const PathSpan ahead{navigator.path.get(), navigator.s_m, path_width_reach_m};
    const PathWidth path = narrowest_on(map, ahead, density_half_band_m);
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
  observe_stages(elapsed_s);
  seen_.deadline_misses = static_cast<std::uint32_t>(board.deadline_misses - last_misses_);
  last_misses_ = board.deadline_misses;
  seen_.queue_drops = static_cast<std::uint32_t>(board.drops - last_drops_);
  last_drops_ = board.drops;
  has_new_knobs_ = has_new_knobs_ || knobs_.computer != board.granted;
  knobs_.computer = board.granted;
  seen_.cores = board.granted.cores;
  seen_.frequency = board.granted.frequency;
  seen_.computer_power = board.computer_power;
  seen_.cpu_power = board.rails.cpu;
  seen_.gpu_power = board.rails.gpu;
  seen_.memory_power = board.rails.memory;
  seen_.soc_power = board.rails.soc;
  seen_.rotor_power = board.rotor_power;
  seen_.battery_percent = board.battery_percent;
  seen_.temperature_c = board.temperature_c;
  seen_.trip_c = board.trip_c;
}

/// Of a stage with several nodes, their loads add up, and the slowest counts for the rest.
void GovernorLoop::observe_stages(double elapsed_s) {
  for (std::size_t stage = 0; stage < stage_count; ++stage) {
    StageUse& use = seen_.stages[stage];
    use = {};
    double core_s = 0.0;
    for (const int node : inputs_.stages[stage]) {
      const NodeUse used = board_.use_of(node);
      core_s += used.busy_core_s;
      if (used.latency >= use.latency) {
        use.latency = used.latency;
        use.gigacycles = used.gigacycles;
      }
    }
    use.load = elapsed_s > 0.0 ? (core_s - last_stage_core_s_[stage]) / elapsed_s : 0.0;
    last_stage_core_s_[stage] = core_s;
  }
}

/// Tells once of each knob whose wished value is not legal in this mission: a mapper may know no
/// cells of .8 m.
void GovernorLoop::note_moved_wishes(JobContext& job) {
  for (const auto& wish : governor_.wished()) {
    const KnobSpec* spec = knobs_.knobs.spec(wish.knob);
    if (spec == nullptr || spec->is_legal(wish.value) || !moved_.insert(spec->name).second) {
      continue;
    }
    char text[96];
    std::snprintf(text, sizeof text, "%s %g is not legal here, %g instead", spec->name.c_str(),
                  wish.value, spec->nearest(wish.value));
    note_event(job, text);
  }
}

/// Each change of the fallback is an event, and so is each new fault of the policy.
void GovernorLoop::note_fallback(JobContext& job) {
  const FlightRestraint restraint{governor_.bound_factor(), governor_.must_hover()};
  has_new_knobs_ = has_new_knobs_ || restraint != knobs_.restraint;
  knobs_.restraint = restraint;
  const bool is_fault = governor_.last_fault() != PolicyFault::none;
  const Fallback fallback = governor_.fallback();
  if (fallback == fallback_ && fallback == Fallback::none) {
    return;
  }
  const std::string why = governor_.why();
  if (is_fault && trouble_.empty()) {
    trouble_ = why;
  }
  if (fallback != fallback_ || why != why_) {
    note_event(job, fallback_text(fallback, why));
  }
  fallback_ = fallback;
  why_ = why;
}

void GovernorLoop::apply(JobContext& job, const Decision& decision) {
  note_moved_wishes(job);
  for (const auto& wish : decision) {
    const double before = knobs_.value(wish.knob);
    if (before == wish.value || !knobs_.knobs.set(wish.knob, wish.value)) {
      continue;
    }
    has_new_knobs_ = true;
    ++knob_changes_;
    note(job, "decision",
         {{"knob", std::string{wish.knob}},
          {"value", wish.value},
          {"before", before},
          {"reason", std::string{to_string(decision.reason)}}});
  }
  note_fallback(job);
  const OperatingPoint wished{static_cast<int>(knobs_.value("cpu.cores")),
                              Hertz{knobs_.value("cpu.frequency_hz")}};
  if (wished != asked_) {  // The board may grant less than this.
    asked_ = wished;
    board_.request(wished);
    knobs_.computer = board_.read().granted;
    has_new_knobs_ = true;
  }
  places_.apply(knobs_.knobs, board_);
}

void add_governor(Graph& graph,
                  const FlightParts& parts,
                  const GovernorInputs& inputs,
                  std::shared_ptr<GovernorLoop> loop) {
  NodeSpec spec;
  spec.name = "govern";
  spec.cost = map_queries_cost;
  spec.trigger = OnPeriod{inputs.period, Duration{}};
  spec.priority = govern_priority;
  spec.reads = {parts.mission.state.index, parts.mission.progress.index};
  if (inputs.navigator) {
    spec.reads.push_back(inputs.navigator->index);
  }
  spec.writes = {parts.mission.knobs.index};
  declare_log(spec, parts.mission);
  graph.node(std::move(spec),
             [loop = std::move(loop)](JobContext& job) { return loop->tick(job); });
}

}  // namespace flyball
