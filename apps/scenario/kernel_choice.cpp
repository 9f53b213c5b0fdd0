// SPDX-License-Identifier: BSD-3-Clause
// tested-in: scenario_parameters

#include "scenario/kernel_choice.h"

#include "flyball/kernels/collision_check.h"
#include "flyball/kernels/coverage_planner.h"
#include "flyball/kernels/detector.h"
#include "flyball/kernels/explorer.h"
#include "flyball/kernels/localizer.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/path_tracker.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/kernels/smoother.h"
#include "flyball/kernels/tracker.h"
#include "flyball/runtime/assert.h"
#include "flyball/scenario/models.h"
#include "flyball/scenario/plugins.h"

#include "scenario/scenario_parameters.h"
#include <algorithm>

namespace flyball {
namespace {

template <class Family, auto kernel, auto parameters>
FamilyChoice family(const char* name, const char* description) {
  return {name,
          description,
          typeid(Family),
          kernel,
          parameters,
          [](Scenario& scenario) { return &(scenario.kernels.*kernel); },
          [] { return all_plugins().names<Family>(); },
          [](const std::string& of) -> std::unique_ptr<Kernel> {
            return all_plugins().make<Family>(of);
          }};
}

std::vector<FamilyChoice> all_families() {
  using K = KernelSettings;
  return {
      family<PointCloudBuilder, &K::point_cloud, &K::point_cloud_parameters>(
          "point_cloud", "depth image to points"),
      family<Mapper, &K::mapper, &K::mapper_parameters>("mapper", "points to occupancy"),
      family<CollisionChecker, &K::collision_check, &K::collision_check_parameters>(
          "collision_check", "looks along the path being flown"),
      family<PathPlanner, &K::planner, &K::planner_parameters>("planner", "shortest path"),
      family<Smoother, &K::smoother, &K::smoother_parameters>("smoother",
                                                              "way-points to a trajectory"),
      family<PathTracker, &K::path_tracker, &K::path_tracker_parameters>(
          "path_tracker", "trajectory to set-points"),
      family<Localizer, &K::localizer, &K::localizer_parameters>(
          "localizer", "where the vehicle believes it is"),
      family<CoveragePlanner, &K::coverage, &K::coverage_parameters>(
          "coverage", "an area to a path over all of it"),
      family<Explorer, &K::explorer, &K::explorer_parameters>("explorer", "where to look next"),
      family<Detector, &K::detector, &K::detector_parameters>("detector",
                                                              "people in colour images"),
      family<Tracker, &K::tracker, &K::tracker_parameters>("tracker",
                                                           "where what was detected goes"),
  };
}

}  // namespace

const std::vector<FamilyChoice>& family_choices() {
  static const std::vector<FamilyChoice> all = all_families();
  return all;
}

const FamilyChoice& family_choice(std::type_index interface) {
  const auto& all = family_choices();
  const auto found = std::find_if(all.begin(), all.end(), [interface](const FamilyChoice& one) {
    return one.interface == interface;
  });
  FLYBALL_ASSERT(found != all.end(), "no family of %s", interface.name());
  return *found;
}

Result<std::unique_ptr<Kernel>> make_kernel(const FamilyChoice& family,
                                            const KernelSettings& kernels,
                                            const FindModel& find_model) {
  auto kernel = family.make(kernels.*family.kernel);
  if (!kernel) {
    return unknown(family.name, kernels.*family.kernel, "kernels");
  }
  const auto chosen =
      resolved(family.owner(kernels), kernel->parameters(), kernels.*family.parameters);
  if (!chosen) {
    return chosen.error();
  }
  if (const Status configured = kernel->configure(*chosen, find_model); !configured) {
    return configured.error();
  }
  return kernel;
}

FindModel model_finder(const Scenario& scenario) {
  return [folder = scenario.detector.models_folder](const std::string& file) {
    return find_model(file, folder);
  };
}

}  // namespace flyball
