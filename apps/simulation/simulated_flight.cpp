// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "simulation/simulated_flight.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include <utility>

namespace flyball {
namespace {

VehicleExtras extras_of(const MissionSetup& setup) {
  const LocalizerInputs wanted = setup.equipment.kernels.localizer->inputs();
  VehicleExtras extras;
  extras.colour_camera = setup.things.cameras.gimbal != nullptr;
  extras.rgbd_camera = setup.equipment.has_rgb_camera;
  extras.imu = wanted.imu;
  extras.true_pose = wanted.truth;
  return extras;
}

/// Whether the localizer's world may lie elsewhere than the one in which the vehicle is flown.
bool localizer_errs(const MissionSetup& setup) {
  return !setup.equipment.kernels.localizer->inputs().truth;
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

}  // namespace

SimulatedFlight::SimulatedFlight(const Scenario& scenario,
                                 MissionSetup& setup,
                                 MemoryRecorder& trace,
                                 std::unique_ptr<Workload> made,
                                 const FlightHardware& on)
    : workload{std::move(made)},
      graph{scenario.mission.workload},
      computer{setup.platform->model()},
      board{start_point(scenario), 100.0 * scenario.vehicle.battery_charge, scenario.seed},
      has_autopilot{on.autopilot != nullptr} {
  parts.brief = adapted_brief(scenario, setup, on);
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
  const auto pose = graph.find<PoseEstimate>("pose");
  if (localizer_errs(setup) && pose) {
    loop->hear_localizer(*pose, graph.find<LocalizationStatus>("localization"));
  }
  referee =
      std::make_unique<Referee>(*link, RefereedFlight{scenario, setup.things, graph, *executor,
                                                      queue, *loop, *parts.kernels.mapper});
  drift = std::make_unique<ComputerDrift>(*link, scenario, computer, *executor, queue, *loop);
  soft_errors = std::make_unique<SoftErrors>(*link, scenario, graph, *executor, queue);
  board.connect(*executor, graph, *loop, drift.get(), on.board);
  recorder = std::make_unique<FlightRecorder>(*link, graph, *loop);
}

std::shared_ptr<const Brief> SimulatedFlight::adapted_brief(const Scenario& scenario,
                                                            const MissionSetup& setup,
                                                            const FlightHardware& on) const {
  Brief brief = brief_of(scenario, setup);
  brief.leaves_errors_to_controller = on.autopilot != nullptr || localizer_errs(setup);
  workload->adapt(brief);
  return std::make_shared<const Brief>(std::move(brief));
}

void SimulatedFlight::add_governing(const Scenario& scenario, MissionSetup& setup) {
  GovernorInputs inputs = governor_inputs(graph);
  period = setup.governor->period().value_or(from_seconds(scenario.governor.period_s));
  inputs.period = period;
  governor =
      std::make_shared<GovernorLoop>(parts, setup.equipment.knobs, *setup.governor, board, inputs);
  add_governor(graph, parts, inputs, governor);
}

}  // namespace flyball
