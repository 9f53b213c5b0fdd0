// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/mission.h"

#include "flyball/records/version.h"

#include "records/fingerprint.h"
#include "simulation/kernel_price.h"
#include "simulation/mission_checks.h"
#include "simulation/mission_setup.h"
#include "simulation/mission_summary.h"
#include "simulation/simulated_flight.h"
#include <cstdio>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto state_period = 100ms;
constexpr auto meter_period = 100ms;  // INA3221 averages over tens of milliseconds.
constexpr auto progress_period = 10s;

void tell_progress(const SimulatedFlight& flight, const MissionHooks& hooks) {
  const Vec3& here_W = flight.loop->vehicle().state().X_WB.translation();
  const auto& navigator = flight.link->navigator();
  const double goal_m = navigator ? (navigator->goal_W - here_W).norm() : 0.0;
  char text[96];
  std::snprintf(text, sizeof text, "%.0f m to go, battery %.0f %%", goal_m,
                flight.loop->battery().percent());
  hooks.progress(to_seconds(flight.queue.now()), text);
}

void connect(SimulatedFlight& flight, const MissionHooks& hooks) {
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
  // A model's heat caps no clock of a computer that is not modeled, so none is modeled for it.
  flight.drift->start(hooks.executor ? std::nullopt : flight.computer.nominal().thermal);
  flight.soft_errors->start();
  flight.board.measure(0.0);
  flight.loop->on_energy([&flight](double dt_s) { flight.board.measure(dt_s); });
}

/// Waits for what is not simulated.
Status make_ready(const SimulatedFlight& flight, const MissionHooks& hooks) {
  const Status seen =
      hooks.depth_camera != nullptr ? hooks.depth_camera->await(hooks.stop) : Status{Done{}};
  return seen ? flight.loop->prepare(hooks.stop) : seen;
}

/// Flies until the mission is over, and what happens at that same moment.
void run(SimulatedFlight& flight, const MissionHooks& hooks) {
  EventQueue& queue = flight.queue;
  do {
    flight.executor->serve_until(queue.next().value_or(queue.now()));
  } while (queue.step() && !flight.link->outcome() && !(hooks.stop && hooks.stop()));
  while (queue.next() && *queue.next() <= queue.now()) {
    (void)queue.step();
  }
  if (hooks.over) {
    hooks.over();
  }
  flight.loop->begin_landing();
  flight.executor->stop();
  flight.executor->run_last(flight.record_node);
  flight.loop->await_landing(hooks.stop);
}

/// What is known at take-off, and where what is forgotten goes.
Status begin_map(const MissionEquipment& equipment, const MissionHooks& hooks) {
  Mapper& mapper = *equipment.kernels.mapper;
  Status done = check_map_name(hooks.final_map);
  if (done && !hooks.start_map.empty()) {
    done = mapper.read(hooks.start_map);
    done = done ? check_start_map(hooks.start_map, equipment) : done;
  }
  if (done && !hooks.final_map.empty()) {
    done = mapper.keep_forgotten(hooks.final_map + ".forgotten");
  }
  return done;
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

Status check_graph(const Scenario& scenario,
                   const MissionSetup& setup,
                   const SimulatedFlight& flight,
                   const MissionHooks& hooks) {
  Status possible = check_room(setup.things, flight.workload->flies_to_goal());
  if (possible) {
    possible = check_start(*flight.parts.brief);
  }
  if (possible &&
      !hooks.executor) {  // One that is given measures what jobs take, or need not know it.
    possible = check_prices_of_nodes(scenario, flight.computer, flight.graph);
    if (possible && setup.edge) {
      possible = check_prices_on_edge(scenario, *setup.edge->platform, flight.graph);
    }
  }
  return possible ? flight.soft_errors->check() : possible;
}

/// What is known of a flight before it begins.
MissionRecord begin_record(const MissionSetup& setup) {
  MissionRecord record;
  record.trace = std::make_shared<MemoryRecorder>();
  record.world = setup.things.world;
  record.knobs = setup.equipment.knobs;
  return record;
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
  const SimulatedFlight flight{scenario, *setup, trace, std::move(*workload)};
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
  Mapper& mapper = *setup->equipment.kernels.mapper;  // Stays where it is when it is handed on.
  if (const Status begun_map = begin_map(setup->equipment, hooks); !begun_map) {
    return begun_map.error();
  }
  MissionRecord record = begin_record(*setup);
  SimulatedFlight flight{scenario,
                         *setup,
                         *record.trace,
                         std::move(*workload),
                         {hooks.executor, hooks.computer, hooks.autopilot}};
  if (const Status possible = check_graph(scenario, *setup, flight, hooks); !possible) {
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
  record.summary = summary_of(flight, scenario);
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
