// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/mission.h"

#include "flyball/flight/governing/governor_loop.h"
#include "flyball/flight/workload.h"
#include "flyball/records/version.h"
#include "flyball/runtime/modeled/virtual_executor.h"
#include "flyball/runtime/quantile.h"

#include "records/fingerprint.h"
#include "simulation/closed_loop.h"
#include "simulation/computer_drift.h"
#include "simulation/flight_recorder.h"
#include "simulation/future_frames.h"
#include "simulation/judging/referee.h"
#include "simulation/kernel_price.h"
#include "simulation/mission_checks.h"
#include "simulation/mission_link.h"
#include "simulation/mission_setup.h"
#include "simulation/simulated_board.h"
#include "simulation/soft_errors.h"
#include <cstdio>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto state_period = 100ms;
constexpr auto meter_period = 100ms;  // INA3221 averages over tens of milliseconds.
constexpr auto progress_period = 10s;

VehicleExtras extras_of(const MissionSetup& setup) {
  const LocalizerInputs wanted = setup.equipment.kernels.localizer->inputs();
  VehicleExtras extras;
  extras.colour_camera = setup.things.cameras.gimbal != nullptr;
  extras.rgbd_camera = setup.equipment.has_rgb_camera;
  extras.imu = wanted.imu;
  extras.true_pose = wanted.truth;
  return extras;
}

OperatingPoint start_point(const Scenario& scenario) {
  return {scenario.platform.cores, Hertz{scenario.platform.frequency_hz}};
}

/// The modeled computer, with the scenario's edge computer.
MakeExecutor modeled(const std::optional<EdgeModel>& edge) {
  return [edge](const Graph& graph, const Platform& computer, EventQueue& queue,
                const OperatingPoint& start) {
    auto executor = std::make_unique<VirtualExecutor>(graph, computer, queue, start);
    if (edge) {
      executor->connect_edge(*edge);
    }
    return executor;
  };
}

/// What of a flight is not simulated.
struct FlightHardware {
  MakeExecutor make_executor{};  ///< Empty: a modeled one.
  RealtimeBoard* board{};        ///< Null for one that is modeled.
  AutopilotLink* autopilot{};    ///< Null: the vehicle is simulated.
};

/// Everything that one flight needs, in the order in which it must be made.
struct Flight {
  Flight(const Scenario& scenario,
         MissionSetup& setup,
         MemoryRecorder& trace,
         std::unique_ptr<Workload> made,
         const FlightHardware& on = {})
      : workload{std::move(made)},
        graph{scenario.mission.workload},
        computer{setup.platform->model()},
        board{start_point(scenario)} {
    parts.brief = adapted_brief(scenario, setup);
    parts.vehicle = add_vehicle_topics(graph, extras_of(setup));
    parts.mission = add_mission_topics(graph);
    parts.kernels = setup.equipment.kernels;
    workload->build(graph, parts);
    add_finish(graph, parts.mission);
    record_node = add_record(graph, parts.mission, trace);
    add_governing(scenario, setup);
    const MakeExecutor make = on.make_executor ? on.make_executor : modeled(setup.edge);
    executor = make(graph, computer, queue, start_point(scenario));
    link = std::make_unique<MissionLink>(parts.brief, graph, parts.mission, *executor, queue);
    loop = std::make_unique<ClosedLoop>(*link, scenario, setup.things, *executor, queue,
                                        parts.vehicle, parts.kernels.localizer, on.autopilot);
    referee =
        std::make_unique<Referee>(*link, RefereedFlight{scenario, setup.things, graph, *executor,
                                                        queue, *loop, *parts.kernels.mapper});
    drift = std::make_unique<ComputerDrift>(*link, scenario, computer, *executor, queue, *loop);
    soft_errors = std::make_unique<SoftErrors>(*link, scenario, graph, *executor, queue);
    board.connect(*executor, graph, *loop, drift.get(), on.board);
    recorder = std::make_unique<FlightRecorder>(*link, graph, *loop);
  }

  [[nodiscard]] std::shared_ptr<const Brief> adapted_brief(const Scenario& scenario,
                                                           const MissionSetup& setup) const {
    Brief brief = brief_of(scenario, setup);
    workload->adapt(brief);
    return std::make_shared<const Brief>(std::move(brief));
  }

  void add_governing(const Scenario& scenario, MissionSetup& setup) {
    GovernorInputs inputs = governor_inputs(graph);
    std::vector<MapSetting> settings = setup.governor->foresees();
    if (!settings.empty() && inputs.navigator && parts.brief->maps_obstacles) {
      future = std::make_unique<FutureFrames>(parts.brief, scenario.plugins, setup.things.world,
                                              computer, std::move(settings));
      inputs.future = future.get();
    }
    period = setup.governor->period().value_or(from_seconds(scenario.governor.period_s));
    inputs.period = period;
    governor = std::make_shared<GovernorLoop>(parts, setup.equipment.knobs, *setup.governor, board,
                                              inputs);
    add_governor(graph, parts, inputs, governor);
  }

  EventQueue queue;
  std::unique_ptr<Workload> workload;
  Graph graph;
  DriftingPlatform computer;  ///< The true one: what is known of it on board is in the brief.
  SimulatedBoard board;
  FlightParts parts;
  int record_node{};
  std::unique_ptr<FutureFrames> future;    ///< Null for a policy that does not ask.
  std::shared_ptr<GovernorLoop> governor;  ///< Owners: its node and this.
  Duration period{};                       ///< Between decisions.
  std::unique_ptr<Executor> executor;
  std::unique_ptr<MissionLink> link;
  std::unique_ptr<ClosedLoop> loop;
  std::unique_ptr<Referee> referee;
  std::unique_ptr<ComputerDrift> drift;
  std::unique_ptr<SoftErrors> soft_errors;
  std::unique_ptr<FlightRecorder> recorder;
};

void tell_progress(const Flight& flight, const MissionHooks& hooks) {
  const Vec3& here_W = flight.loop->vehicle().state().X_WB.translation();
  const auto& navigator = flight.link->navigator();
  const double goal_m = navigator ? (navigator->goal_W - here_W).norm() : 0.0;
  char text[96];
  std::snprintf(text, sizeof text, "%.0f m to go, battery %.0f %%", goal_m,
                flight.loop->battery().percent());
  hooks.progress(to_seconds(flight.queue.now()), text);
}

void connect(Flight& flight, const MissionHooks& hooks) {
  auto& queue = flight.queue;
  flight.executor->on_job([&flight](const JobRecord& job) { flight.recorder->record_job(job); });
  if (Timeline* timeline = hooks.timeline) {
    timeline->begin(flight.graph);
    flight.executor->on_job([timeline](const JobRecord& job) { timeline->note(job); });
  }
  if (hooks.job) {
    flight.executor->on_job([&flight, &hooks](const JobRecord& job) {
      hooks.job(flight.graph.nodes()[static_cast<std::size_t>(job.node)].spec, job);
    });
  }
  flight.loop->cameras().render(hooks.rendering);
  flight.loop->cameras().take_depth_from(hooks.depth_camera);
  if (hooks.onboard_record != nullptr) {
    hooks.onboard_record->connect({flight.graph, *flight.executor,
                                   [&flight] { return flight.queue.now(); },
                                   flight.parts.brief->settings.camera});
  }
  flight.executor->on_miss([&flight](int, OnMiss action) {
    if (action == OnMiss::brake && flight.link->phase() == MissionPhase::cruise) {
      flight.loop->emergency_hold();
    }
  });
  flight.link->log("governor", {{"period_s", to_seconds(flight.period)}});
  queue.every(MissionTime{}, state_period, EventOrder::observer,
              [&flight] { flight.recorder->record_state(); });
  if (hooks.computer != nullptr) {
    queue.every(MissionTime{}, meter_period, EventOrder::observer,
                [&flight, computer = hooks.computer] {
                  computer->refresh(flight.queue.now().time_since_epoch());
                });
    flight.loop->measure_computer(
        [computer = hooks.computer] { return computer->meters().computer_power; });
  }
  if (hooks.progress) {
    queue.every(MissionTime{progress_period}, progress_period, EventOrder::observer,
                [&flight, &hooks] { tell_progress(flight, hooks); });
  }
  flight.loop->start();
  flight.referee->start();
  flight.drift->start(flight.computer.nominal().thermal);
  flight.soft_errors->start();
  flight.board.measure();
  flight.loop->on_energy([&flight] { flight.board.measure(); });
}

/// Waits for what is not simulated.
Status make_ready(const Flight& flight, const MissionHooks& hooks) {
  const Status seen =
      hooks.depth_camera != nullptr ? hooks.depth_camera->await(hooks.stop) : Status{Done{}};
  return seen ? flight.loop->prepare(hooks.stop) : seen;
}

/// Flies until the mission is over, and what happens at that same moment.
void run(Flight& flight, const MissionHooks& hooks) {
  EventQueue& queue = flight.queue;
  do {
    flight.executor->serve_until(queue.next().value_or(queue.now()));
  } while (queue.step() && !flight.link->outcome() && !(hooks.stop && hooks.stop()));
  while (queue.next() && *queue.next() <= queue.now()) {
    (void)queue.step();
  }
  flight.loop->begin_landing();
  flight.executor->stop();
  flight.executor->run_last(flight.record_node);
  flight.loop->await_landing(hooks.stop);
}

void fill_outcome(Summary& summary, const Flight& flight, const Scenario& scenario) {
  const FlightLog& log = flight.loop->log();
  summary.scenario = scenario.name;
  summary.policy = scenario.governor.policy;
  summary.seed = scenario.seed;
  const FlightVerdict verdict = flight.referee->verdict();
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
  const MapUses& maps = flight.link->map_uses();
  const auto& navigator = flight.link->navigator();
  summary.replans = navigator ? navigator->replans : 0;
  summary.deadline_misses = flight.board.read().deadline_misses;
  summary.decisions = flight.governor->decisions();
  summary.knob_changes = flight.governor->knob_changes();
  summary.policy_faults = flight.governor->faults();
  summary.policy_trouble = flight.governor->trouble();
  summary.latency_p50_s = quantile(maps.latency_s, 0.5);
  summary.latency_p95_s = quantile(maps.latency_s, 0.95);
  summary.latency_max_s = quantile(maps.latency_s, 1.0);
  summary.maps = maps.budget_use.size();
  summary.bound_overruns = maps.overruns;
  summary.budget_use_p50 = quantile(maps.budget_use, 0.5);
  summary.latency_bounds = flight.governor->bound_levels();
  summary.decision_host_us_p50 = quantile(flight.governor->decision_host_us(), 0.5);
  summary.decision_host_us_p99 = quantile(flight.governor->decision_host_us(), 0.99);
  summary.throttle_events = flight.drift->throttle_events();
  summary.hottest_c = flight.drift->hottest_c();
  summary.kernels = flight.recorder->kernels();
  summary.quality = flight.workload->quality();
  summary.quality.merge(flight.referee->figures());
  if (const Duration late = flight.executor->longest_delay(); late > Duration::zero()) {
    summary.quality["simulator_late_s_max"] = to_seconds(late);
  }
  if (const FlightLog& log = flight.loop->log(); log.measured_s > 0.0) {
    summary.quality["rotor_power_measured_percent"] = 100.0 * log.measured_s / log.airborne_s;
    if (log.reported_battery->percent) {
      summary.quality["autopilot_battery_percent"] = *log.reported_battery->percent;
    }
  }
  if (const SoftErrors& errors = *flight.soft_errors; errors.is_used()) {
    summary.quality["bit_flips"] = static_cast<double>(errors.flips());
    summary.quality["readers_lost"] = static_cast<double>(errors.lost());
    summary.quality["refused_messages"] = static_cast<double>(errors.refused());
  }
  if (const auto& localization = flight.link->localization()) {
    summary.quality["localization_lost"] = localization->times_lost;
    summary.quality["localization_lost_s"] = localization->lost_s;
  }
}

Result<std::unique_ptr<Workload>> named_workload(const Scenario& scenario) {
  auto workload = scenario.plugins.make<Workload>(scenario.mission.workload);
  if (!workload) {
    return Error{ErrorCode::not_found,
                 "no workload \"" + scenario.mission.workload + "\"; try: flyball list workloads"};
  }
  return workload;
}

Result<std::unique_ptr<Workload>> make_workload(const Scenario& scenario, const World& world) {
  auto workload = named_workload(scenario);
  if (workload) {
    if (const Status possible =
            (*workload)->check(flight_settings(scenario), site_of(world, scenario.world.generator));
        !possible) {
      return possible.error();
    }
  }
  return workload;
}

/// An answer that comes too late is a fault where a real computer is governed.
PolicyGovernor::HostClock watchdog_clock(const MissionHooks& hooks) {
  return hooks.computer != nullptr ? PolicyGovernor::HostClock{HostTime::clock::now} : nullptr;
}

Status check_graph(const Scenario& scenario, const Flight& flight, const MissionHooks& hooks) {
  const Status priced = hooks.executor  // Which measures what jobs take, or need not know it.
                            ? Done{}
                            : check_prices_of_nodes(scenario, flight.computer, flight.graph);
  return priced ? flight.soft_errors->check() : priced;
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
  auto setup = set_up(scenario, watchdog_clock(hooks));
  if (!setup) {
    return setup.error();
  }
  if (const Status possible = check_executor(scenario, hooks); !possible) {
    return possible.error();
  }
  auto workload = make_workload(scenario, setup->things.world);
  if (!workload) {
    return workload.error();
  }
  if (const Status real = check_depth_camera(scenario, *setup, hooks); !real) {
    return real.error();
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
  Flight flight{scenario,
                *setup,
                *record.trace,
                std::move(*workload),
                {hooks.executor, hooks.computer, hooks.autopilot}};
  if (const Status possible = check_graph(scenario, flight, hooks); !possible) {
    return possible.error();
  }
  if (const Status ready = make_ready(flight, hooks); !ready) {
    return ready.error();
  }
  connect(flight, hooks);
  run(flight, hooks);
  if (!hooks.final_map.empty()) {
    record.map_file = mapper.write(hooks.final_map, std::nullopt);
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
