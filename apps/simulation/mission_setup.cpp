// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mission_setup.h"

#include "flyball/flight/workload.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/policy_choice.h"
#include "flyball/scenario/shipped_platform.h"
#include "flyball/sim/gimbal.h"
#include "flyball/sim/worlds.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_check.h"
#include "scenario/scenario_edge.h"
#include "scenario/scenario_parameters.h"
#include "simulation/kernel_price.h"
#include "simulation/seeing_setup.h"
#include <cmath>

namespace flyball {
namespace {

/// What `ClosedLoop` hangs under the vehicle beside its payload, for a workload that looks for
/// people.
double gimbal_kg(const Scenario& scenario) {
  const auto workload = scenario.plugins.make<Workload>(scenario.mission.workload);
  return workload && workload->looks_for_people() ? GimbalSpec{}.mass_kg : 0.0;
}

Status check_lift(const Scenario& scenario, const Airframe& airframe) {
  const double most_kg = airframe.most_payload_kg();
  const double gimbal = gimbal_kg(scenario);
  if (scenario.vehicle.payload_kg + gimbal <= most_kg) {
    return Done{};
  }
  const std::string with_gimbal = gimbal > 0.0 ? " with the gimbal of " + number_text(gimbal) +
                                                     " kg that workload \"" +
                                                     scenario.mission.workload + "\" needs"
                                               : "";
  return Error{ErrorCode::invalid_input,
               "vehicle.payload_kg = " + number_text(scenario.vehicle.payload_kg) + with_gimbal +
                   " is too heavy for airframe \"" + scenario.vehicle.airframe +
                   "\", which lifts " + number_text(std::floor(1e3 * most_kg) / 1e3) +
                   " with a fifth of its thrust to spare; " +
                   (gimbal < most_kg ? "carry less" : "choose a larger vehicle.airframe")};
}

Result<Airframe> make_airframe(const Scenario& scenario) {
  const auto file = find_shipped("airframes", scenario.vehicle.airframe);
  auto airframe = file ? load_airframe(*file) : Result<Airframe>{file.error()};
  if (!airframe) {
    return airframe;
  }
  if (scenario.vehicle.rotor_power == "regression" && !airframe->has_regression()) {
    return Error{
        ErrorCode::invalid_input,
        "vehicle.rotor_power = \"regression\" needs the coefficients of eq. 1, and airframe \"" +
            scenario.vehicle.airframe + "\" has none; set vehicle.rotor_power to \"thrust\""};
  }
  if (const Status lifts = check_lift(scenario, *airframe); !lifts) {
    return lifts.error();
  }
  return airframe;
}

Result<std::unique_ptr<ModeledPlatform>> make_platform(const Scenario& scenario) {
  auto model = find_platform(scenario.platform.name);
  if (!model) {
    return model.error();
  }
  return std::make_unique<ModeledPlatform>(std::move(*model));
}

Result<World> make_world(const Scenario& scenario) {
  const auto generator = scenario.plugins.make<WorldGenerator>(scenario.world.generator);
  if (!generator) {
    return unknown("world", scenario.world.generator, "worlds");
  }
  const auto parameters = resolved("world \"" + scenario.world.generator + "\"",
                                   generator->parameters(), scenario.world.parameters);
  if (!parameters) {
    return parameters.error();
  }
  return generator->make(*parameters, scenario.seed);
}

/// Makes one kernel, or adds a sentence to `missing`.
template <class Family>
void make(std::shared_ptr<Family>& kernel, const Scenario& scenario, std::vector<Error>& missing) {
  auto made = make_switchable<Family>(scenario, model_finder(scenario));
  if (made) {
    kernel = std::move(*made);
  } else {
    missing.push_back(made.error());
  }
}

Result<MissionKernels> make_kernels(const Scenario& scenario, const GeodeticOrigin& origin) {
  MissionKernels kernels;
  std::vector<Error> missing;
  make(kernels.point_cloud, scenario, missing);
  make(kernels.mapper, scenario, missing);
  make(kernels.collision_check, scenario, missing);
  make(kernels.planner, scenario, missing);
  make(kernels.smoother, scenario, missing);
  make(kernels.path_tracker, scenario, missing);
  make(kernels.localizer, scenario, missing);
  make(kernels.coverage, scenario, missing);
  make(kernels.explorer, scenario, missing);
  if (!missing.empty()) {
    return joined(missing);
  }
  kernels.localizer->start(origin);
  return kernels;
}

/// Whether the mission's map can be made, and what its jobs cost is known.
Status check_mapping(const Scenario& scenario, const MissionSetup& setup) {
  const Aabb& bounds_W = setup.things.world.bounds_W;
  if (const auto errors = check_map(scenario, {}, {bounds_W.min, bounds_W.max}); !errors.empty()) {
    return joined(errors);
  }
  const std::string priced_as = mapper_cost(scenario.kernels);
  return check_price(scenario, *setup.platform,
                     {priced_as, "mapper \"" + priced_as + "\"", "its map",
                      "set kernels.mapper_parameters.cost_of to \"octomap\", or "});
}

Result<std::unique_ptr<PolicyGovernor>> make_governor(const Scenario& scenario,
                                                      const KnobSettings& knobs,
                                                      const BoardModel& board,
                                                      PolicyGovernor::HostClock clock) {
  auto policy = start_policy(scenario, knobs, board);
  if (!policy) {
    return policy.error();
  }
  return std::make_unique<PolicyGovernor>(std::move(*policy), knobs, PolicyGovernorSettings{},
                                          std::move(clock));
}

BoardModel known_on_board(const Scenario& scenario, const MissionSetup& setup) {
  BoardModel board = board_model_of(setup.platform->model());
  const Brief brief = brief_of(scenario, setup);
  const Cylinder body = brief.narrow_body();
  board.vehicle.narrow_width_m = 2.0 * body.radius_m;
  board.vehicle.ground_clearance_m = brief.site.cruise_height_m - body.half_height_m;
  board.vehicle.depth_camera = scenario.camera;
  board.vehicle.reaction_time = guard_settings(brief.settings).reaction_time();
  return board;
}

}  // namespace

Site site_of(const World& world, const std::string& name) {
  return {name,
          world.bounds_W,
          world.zones,
          world.start_W,
          world.goal_W,
          world.start_clear_m,
          world.goal_clear_m,
          world.clear_height_m,
          world.cruise_height_m,
          world.ground_z_m,
          world.open_above_m,
          world.volume_W};
}

Brief brief_of(const Scenario& scenario, const MissionSetup& setup) {
  Brief brief;
  brief.settings = flight_settings(scenario);
  brief.site = site_of(setup.things.world, scenario.world.generator);
  brief.platform = setup.platform;
  brief.body = setup.equipment.body;
  brief.tube.at_rest_m = scenario.vehicle.tracking_error_m;
  brief.sees_its_place = setup.equipment.kernels.localizer->inputs().images;
  return brief;
}

Workbench workbench_of(const Scenario& scenario, const MissionSetup& setup) {
  return {brief_of(scenario, setup), knobs_at_start(setup.equipment.knobs),
          setup.equipment.kernels};
}

Result<MissionSetup> set_up(const Scenario& scenario, PolicyGovernor::HostClock clock) {
  auto setup = set_up_without_governor(scenario);
  if (!setup) {
    return setup;
  }
  auto governor = make_governor(scenario, setup->equipment.knobs, known_on_board(scenario, *setup),
                                std::move(clock));
  if (!governor) {
    return governor.error();
  }
  setup->governor = std::move(*governor);
  return setup;
}

Result<MissionSetup> set_up_without_governor(const Scenario& scenario) {
  MissionSetup setup;
  auto platform = make_platform(scenario);
  if (!platform) {
    return platform.error();
  }
  setup.platform = std::move(*platform);
  auto edge = make_edge(scenario);
  if (!edge) {
    return edge.error();
  }
  setup.edge = std::move(*edge);
  auto airframe = make_airframe(scenario);
  if (!airframe) {
    return airframe.error();
  }
  setup.things.airframe = std::move(*airframe);
  setup.equipment.body = setup.things.airframe.body();
  auto world = make_world(scenario);
  if (!world) {
    return world.error();
  }
  setup.things.world = std::move(*world);
  auto kernels = make_kernels(scenario, setup.things.origin);
  if (!kernels) {
    return kernels.error();
  }
  setup.equipment.kernels = std::move(*kernels);
  auto cameras = equip_to_see(scenario, *setup.platform, setup.things.world, setup.equipment);
  if (!cameras) {
    return cameras.error();
  }
  setup.things.cameras = std::move(*cameras);
  if (const Status mapped = check_mapping(scenario, setup); !mapped) {
    return mapped.error();
  }
  auto knobs = standard_knobs(scenario, *setup.platform);
  if (!knobs) {
    return knobs.error();
  }
  setup.equipment.knobs = KnobSettings{std::move(*knobs)};
  return setup;
}

}  // namespace flyball
