// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/seeing_setup.h"

#include "flyball/flight/workload.h"
#include "flyball/scenario/models.h"
#include "flyball/simulation/mission.h"

#include "flight/perception/visual_nodes.h"
#include "scenario/scenario_parameters.h"

namespace flyball {
namespace {

Result<std::unique_ptr<Tracker>> make_tracker(const std::string& name) {
  auto tracker = all_plugins().make<Tracker>(name);
  if (!tracker) {
    return unknown("tracker", name, "kernels");
  }
  const auto chosen = resolved("tracker \"" + name + "\"", tracker->parameters(), {});
  if (!chosen) {
    return chosen.error();
  }
  tracker->configure(*chosen);
  return tracker;
}

Status check_price(const Scenario& scenario, const Platform& platform) {
  const std::string priced_as = detector_cost(scenario);
  if (platform.knows(priced_as)) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input, "platform \"" + scenario.platform.name +
                                             "\" has no price for detector \"" + priced_as +
                                             "\", so looking for people would cost no time; set " +
                                             "detector.cost_of to \"hog\", or add [kernels." +
                                             priced_as + "] to the platform file"};
}

Status open_eye(const Scenario& scenario,
                const Platform& platform,
                const World& world,
                MissionEquipment& equipment) {
  const auto& localizer = equipment.kernels.localizer;
  if (!localizer || !localizer->inputs().images) {
    return Done{};
  }
  const std::string priced_as = frame_cost(scenario.kernels.localizer);
  if (!platform.knows(priced_as)) {
    return Error{ErrorCode::invalid_input,
                 "platform \"" + scenario.platform.name + "\" has no price for localizer \"" +
                     scenario.kernels.localizer + "\", so its frames would cost no time; add " +
                     "[kernels." + priced_as + "] to the platform file"};
  }
  auto eye = ColourCamera::make(world, colour_beside(scenario.camera));
  if (!eye) {
    return eye.error();
  }
  equipment.eye = std::move(*eye);
  return Done{};
}

}  // namespace

Result<std::unique_ptr<Detector>> make_detector(const Scenario& scenario) {
  const std::string& name = scenario.kernels.detector;
  auto detector = all_plugins().make<Detector>(name);
  if (!detector) {
    return unknown("detector", name, "kernels");
  }
  const auto chosen = resolved("detector \"" + name + "\"", detector->parameters(),
                               scenario.kernels.detector_parameters);
  if (!chosen) {
    return chosen.error();
  }
  const Status started = detector->start(*chosen, [&scenario](const std::string& file) {
    return find_model(file, scenario.detector.models_folder);
  });
  if (!started) {
    return started.error();
  }
  return detector;
}

std::string detector_cost(const Scenario& scenario) {
  return scenario.detector.cost_of == "own" ? scenario.kernels.detector : scenario.detector.cost_of;
}

Status equip_to_see(const Scenario& scenario,
                    const Platform& platform,
                    const World& world,
                    MissionEquipment& equipment) {
  if (const Status opened = open_eye(scenario, platform, world, equipment); !opened) {
    return opened.error();
  }
  const auto workload = all_plugins().make<Workload>(scenario.mission.workload);
  if (!workload || !workload->looks_for_people()) {
    return Done{};
  }
  if (const Status priced = check_price(scenario, platform); !priced) {
    return priced.error();
  }
  auto detector = make_detector(scenario);
  if (!detector) {
    return detector.error();
  }
  equipment.kernels.detector = std::move(*detector);
  for (auto* place : {&equipment.kernels.buffered_tracker, &equipment.kernels.real_time_tracker}) {
    auto tracker = make_tracker(scenario.kernels.tracker);
    if (!tracker) {
      return tracker.error();
    }
    *place = std::move(*tracker);
  }
  auto camera = ColourCamera::make(world, scenario.colour_camera);
  if (!camera) {
    return camera.error();
  }
  equipment.colour_camera = std::move(*camera);
  return Done{};
}

}  // namespace flyball
