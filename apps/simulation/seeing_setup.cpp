// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/seeing_setup.h"

#include "flyball/flight/workload.h"

#include "scenario/kernel_choice.h"
#include "simulation/kernel_price.h"

namespace flyball {
namespace {

Status check_prices(const Scenario& scenario, const Platform& platform) {
  const std::string detector = detector_cost(flight_settings(scenario));
  Status priced = check_price(scenario, platform,
                              {detector, "detector \"" + detector + "\"", "looking for people",
                               "set detector.cost_of to \"hog\", or "});
  for (const std::string use : {"_buffered", "_real_time"}) {
    const std::string& tracker = scenario.kernels.tracker;
    if (priced) {
      priced = check_price(scenario, platform,
                           {tracker + use, "tracker \"" + tracker + "\"", "tracking", ""});
    }
  }
  return priced;
}

/// Null with a localizer that takes no images.
Result<std::unique_ptr<ColourCamera>> make_forward_camera(const Scenario& scenario,
                                                          const Platform& platform,
                                                          const World& world,
                                                          const MissionEquipment& equipment) {
  const auto& localizer = equipment.kernels.localizer;
  if (!localizer || !localizer->inputs().images) {
    return std::unique_ptr<ColourCamera>{};
  }
  const std::string priced_as = frame_cost(scenario.kernels.localizer);
  if (const Status priced = check_price(
          scenario, platform,
          {priced_as, "localizer \"" + scenario.kernels.localizer + "\"", "its frames", ""});
      !priced) {
    return priced.error();
  }
  return ColourCamera::make(world, colour_beside(scenario.camera));
}

}  // namespace

ColourCameraSpec colour_beside(const DepthCameraSpec& depth) {
  ColourCameraSpec colour;
  colour.width_px = depth.width_px;
  colour.height_px = depth.height_px;
  colour.horizontal_field_rad = depth.horizontal_field_rad;
  colour.rate_hz = depth.rate_hz;
  return colour;
}

Result<ColourCameras> equip_to_see(const Scenario& scenario,
                                   const Platform& platform,
                                   const World& world,
                                   MissionEquipment& equipment) {
  ColourCameras cameras;
  auto forward = make_forward_camera(scenario, platform, world, equipment);
  if (!forward) {
    return forward.error();
  }
  cameras.forward = std::move(*forward);
  equipment.has_rgb_camera = cameras.forward != nullptr;
  const auto workload = scenario.plugins.make<Workload>(scenario.mission.workload);
  if (!workload || !workload->looks_for_people()) {
    return cameras;
  }
  if (const Status priced = check_prices(scenario, platform); !priced) {
    return priced.error();
  }
  const FindModel find_model = model_finder(scenario);
  auto detector = make_switchable<Detector>(scenario, find_model);
  if (!detector) {
    return detector.error();
  }
  equipment.kernels.detector = std::move(*detector);
  for (auto* place : {&equipment.kernels.buffered_tracker, &equipment.kernels.real_time_tracker}) {
    auto tracker = make_kernel<Tracker>(scenario.plugins, scenario.kernels, find_model);
    if (!tracker) {
      return tracker.error();
    }
    *place = std::move(*tracker);
  }
  auto camera = ColourCamera::make(world, scenario.colour_camera);
  if (!camera) {
    return camera.error();
  }
  cameras.gimbal = std::move(*camera);
  return cameras;
}

}  // namespace flyball
