// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/mission.h"

#include "flyball/flight/governing/governor_loop.h"
#include "flyball/flight/workload.h"
#include "flyball/records/version.h"
#include "flyball/runtime/quantile.h"
#include "flyball/scenario/plugins.h"

#include "records/fingerprint.h"
#include "simulation/closed_loop.h"
#include "simulation/computer_drift.h"
#include "simulation/flight_recorder.h"
#include "simulation/future_frames.h"
#include "simulation/mission_setup.h"
#include "simulation/referee.h"
#include "simulation/simulated_board.h"
#include <cstdio>
#include <filesystem>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto state_period = 100ms;
constexpr auto progress_period = 10s;

VehicleExtras extras_of(const MissionSetup& setup, const MissionContext& context) {
  const auto& localizer = context.kernels.localizer;
  return {setup.things.cameras.gimbal != nullptr, localizer && localizer->inputs().truth};
}

/// Everything that one flight needs, in the order in which it must be made.
struct Flight {
  Flight(const Scenario& scenario,
         MissionSetup& setup,
         MemoryRecorder& trace,
         std::unique_ptr<Workload> made)
      : context{flight_settings(scenario), *setup.platform, trace,
                brief_of(setup.things.world, scenario.world.generator), std::move(setup.equipment)},
        workload{std::move(made)},
        graph{scenario.mission.workload},
        period{setup.governor->period()},
        computer{setup.platform->model()},
        topics{add_vehicle_topics(graph, extras_of(setup, context))} {
    workload->build(graph, topics, context);
    executor = std::make_unique<VirtualExecutor>(
        graph, computer, queue,
        OperatingPoint{scenario.platform.cores, Hertz{scenario.platform.frequency_hz}});
    loop = std::make_unique<ClosedLoop>(context, scenario, setup.things, *executor, queue, topics);
    referee =
        std::make_unique<Referee>(context, scenario, setup.things, graph, *executor, queue, *loop);
    drift = std::make_unique<ComputerDrift>(context, scenario, computer, *executor, queue, *loop);
    board = std::make_unique<SimulatedBoard>(*executor, *loop, drift.get());
    future = foresight(*setup.governor, setup.things.world);
    governor = std::make_unique<GovernorLoop>(context, *setup.governor, *board,
                                              workload->navigator(), future.get());
    recorder = std::make_unique<FlightRecorder>(context, graph, *loop, workload->navigator());
  }

  [[nodiscard]] std::unique_ptr<FutureFrames> foresight(const PolicyGovernor& asks,
                                                        const World& world) const {
    std::vector<MapSetting> settings = asks.policy().foresees();
    if (settings.empty() || workload->navigator() == nullptr || !context.maps_obstacles) {
      return nullptr;
    }
    return std::make_unique<FutureFrames>(context, world, computer, std::move(settings));
  }

  EventQueue queue;
  MissionContext context;
  std::unique_ptr<Workload> workload;
  Graph graph;
  std::optional<Duration> period;  ///< Between decisions, if the policy says.
  DriftingPlatform computer;  ///< The true one: what is known of it on board is in the context.
  VehicleTopics topics;
  std::unique_ptr<VirtualExecutor> executor;
  std::unique_ptr<ClosedLoop> loop;
  std::unique_ptr<Referee> referee;
  std::unique_ptr<ComputerDrift> drift;
  std::unique_ptr<SimulatedBoard> board;
  std::unique_ptr<FutureFrames> future;  ///< Null for a policy that does not ask.
  std::unique_ptr<GovernorLoop> governor;
  std::unique_ptr<FlightRecorder> recorder;
};

void connect(Flight& flight, const Scenario& scenario, const MissionHooks& hooks) {
  auto& queue = flight.queue;
  flight.executor->on_job([&flight](const JobRecord& job) { flight.recorder->record_job(job); });
  flight.executor->on_miss([&flight](int, OnMiss action) {
    flight.governor->count_miss();
    if (action == OnMiss::brake && flight.context.phase == MissionPhase::cruise) {
      flight.loop->emergency_hold();
    }
  });
  const Duration period = flight.period.value_or(from_seconds(scenario.governor.period_s));
  flight.context.recorder.record(MissionTime{}, "governor", {{"period_s", to_seconds(period)}});
  queue.every(MissionTime{}, period, EventOrder::governor,
              [&flight] { flight.governor->tick(flight.queue.now()); });
  queue.every(MissionTime{}, state_period, EventOrder::observer,
              [&flight] { flight.recorder->record_state(flight.queue.now()); });
  if (hooks.progress) {
    queue.every(
        MissionTime{progress_period}, progress_period, EventOrder::observer, [&flight, &hooks] {
          const double goal_m =
              (flight.context.goal_now_W - flight.loop->vehicle().state().X_WB.translation())
                  .norm();
          char text[96];
          std::snprintf(text, sizeof text, "%.0f m to go, battery %.0f %%", goal_m,
                        flight.loop->battery().percent());
          hooks.progress(to_seconds(flight.queue.now()), text);
        });
  }
  flight.loop->start();
  flight.referee->start();
  flight.drift->start(flight.computer.nominal().thermal);
}

void fill_outcome(Summary& summary, const Flight& flight, const Scenario& scenario) {
  const FlightLog& log = flight.loop->log();
  summary.scenario = scenario.name;
  summary.policy = scenario.governor.policy;
  summary.seed = scenario.seed;
  const Verdict verdict = flight.referee->verdict();
  summary.status = verdict.status;
  summary.failure = verdict.failure;
  summary.mission_time_s = to_seconds(flight.queue.now());
  summary.energy_rotor_j = log.energy_rotor_j;
  summary.energy_computer_j = log.energy_computer_j;
  summary.battery_start_percent = 100.0 * scenario.vehicle.battery_charge;
  summary.battery_end_percent = flight.loop->battery().percent();
  summary.distance_m = log.distance_m;
  summary.mean_speed_m_s = log.airborne_s > 0.0 ? log.distance_m / log.airborne_s : 0.0;
  summary.max_speed_m_s = log.max_speed_m_s;
  summary.hover_time_s = log.hover_time_s;
  summary.min_clearance_m = flight.referee->min_clearance_m();
}

void fill_computing(Summary& summary, const Flight& flight) {
  const MissionCounters& counters = flight.context.counters;
  summary.replans = counters.replans;
  summary.deadline_overruns = flight.governor->misses() + counters.bound_overruns;
  summary.decisions = flight.governor->decisions();
  summary.knob_changes = flight.governor->knob_changes();
  summary.policy_faults = flight.governor->faults();
  summary.policy_trouble = flight.governor->trouble();
  summary.latency_p50_s = quantile(counters.latency_s, 0.5);
  summary.latency_p95_s = quantile(counters.latency_s, 0.95);
  summary.latency_max_s = quantile(counters.latency_s, 1.0);
  summary.maps = counters.budget_use.size();
  summary.bound_overruns = counters.bound_overruns;
  summary.budget_use_p50 = quantile(counters.budget_use, 0.5);
  summary.promises = flight.governor->promise_levels();
  summary.decision_host_us_p50 = quantile(flight.governor->decision_host_us(), 0.5);
  summary.decision_host_us_p99 = quantile(flight.governor->decision_host_us(), 0.99);
  summary.throttle_events = flight.drift->throttle_events();
  summary.hottest_c = flight.drift->hottest_c();
  summary.kernels = flight.recorder->kernels();
  summary.quality = flight.workload->quality();
  summary.quality.merge(flight.referee->figures());
  summary.quality.merge(flight.context.localization.quality(flight.queue.now()));
}

Result<std::unique_ptr<Workload>> named_workload(const Scenario& scenario) {
  auto workload = all_plugins().make<Workload>(scenario.mission.workload);
  if (!workload) {
    return Error{ErrorCode::not_found,
                 "no workload \"" + scenario.mission.workload + "\"; try: flyball list workloads"};
  }
  return workload;
}

Result<std::unique_ptr<Workload>> make_workload(const Scenario& scenario, const World& world) {
  auto workload = named_workload(scenario);
  if (workload) {
    if (const Status possible = (*workload)->check(flight_settings(scenario),
                                                   brief_of(world, scenario.world.generator));
        !possible) {
      return possible.error();
    }
  }
  return workload;
}

/// Before the flight: after it a wrong name would cost the map.
Status check_map_name(const std::string& path) {
  const std::string ending = std::filesystem::path{path}.extension().string();
  if (path.empty() || ending == ".bt" || ending == ".ot") {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               "map file \"" + path + "\" must end in .bt (free or occupied) or .ot (log-odds)"};
}

}  // namespace

Result<std::string> describe_graph(const Scenario& scenario, bool as_dot) {
  auto setup = set_up(scenario);
  if (!setup) {
    return setup.error();
  }
  auto workload = named_workload(scenario);  // Drawn even for a world that it cannot fly in.
  if (!workload) {
    return workload.error();
  }
  MemoryRecorder trace;
  const Flight flight{scenario, *setup, trace, std::move(*workload)};
  return as_dot ? flight.graph.to_dot() : flight.graph.to_text();
}

Result<MissionRecord> fly(const Scenario& scenario, const MissionHooks& hooks) {
  const HostTime begun = HostTime::clock::now();
  auto setup = set_up(scenario);
  if (!setup) {
    return setup.error();
  }
  auto workload = make_workload(scenario, setup->things.world);
  if (!workload) {
    return workload.error();
  }
  if (const Status named = check_map_name(hooks.final_map); !named) {
    return named.error();
  }
  Mapper& mapper = *setup->equipment.kernels.mapper;  // Stays where it is when it is handed on.
  if (const Status read = hooks.start_map.empty() ? Done{} : mapper.read(hooks.start_map); !read) {
    return read.error();
  }
  if (const Status kept =
          hooks.final_map.empty() ? Done{} : mapper.keep_forgotten(hooks.final_map + ".forgotten");
      !kept) {
    return kept.error();
  }
  MissionRecord record;
  record.trace = std::make_shared<MemoryRecorder>();
  record.world = setup->things.world;
  Flight flight{scenario, *setup, *record.trace, std::move(*workload)};
  connect(flight, scenario, hooks);
  flight.queue.run([&] { return flight.context.is_over() || (hooks.stop && hooks.stop()); });
  if (const Status written =
          hooks.final_map.empty() ? Done{} : mapper.write(hooks.final_map, std::nullopt);
      !written) {
    return written.error();
  }
  fill_outcome(record.summary, flight, scenario);
  fill_computing(record.summary, flight);
  record.has_goal = flight.workload->flies_to_goal();
  if (record.world.volume_W.max.x() > record.world.volume_W.min.x()) {
    record.map = mapper.occupied();
  }
  record.frames = flight.referee->frames();
  record.summary.trace_hash = record.trace->hash().hex();
  record.summary.numeric_fingerprint = numeric_fingerprint();
  record.summary.version = version();
  record.summary.host_s = std::chrono::duration<double>(HostTime::clock::now() - begun).count();
  record.summary.real_time_factor = record.summary.mission_time_s / record.summary.host_s;
  return record;
}

}  // namespace flyball
