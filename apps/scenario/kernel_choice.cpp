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
#include "flyball/runtime/text/listed.h"
#include "flyball/scenario/models.h"

#include "scenario/scenario_parameters.h"
#include <algorithm>
#include <sstream>
#include <utility>

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
          [](const Plugins& plugins) { return plugins.names<Family>(); },
          [](const Plugins& plugins, const std::string& of) -> std::unique_ptr<Kernel> {
            return plugins.make<Family>(of);
          }};
}

/// With a knob that chooses among several in flight.
template <class Family, class Switched, auto kernel, auto parameters, auto kinds>
FamilyChoice switched_family(const char* name, const char* description) {
  FamilyChoice choice = family<Family, kernel, parameters>(name, description);
  choice.kinds = kinds;
  choice.join = [](std::vector<KernelKind<Kernel>> any) -> std::unique_ptr<Kernel> {
    std::vector<KernelKind<Family>> all;
    all.reserve(any.size());
    for (KernelKind<Kernel>& one : any) {
      all.push_back({std::move(one.name), of_family<Family>(std::move(one.kernel))});
    }
    return std::make_unique<Switched>(std::move(all));
  };
  return choice;
}

std::vector<FamilyChoice> all_families() {
  using K = KernelSettings;
  return {
      family<PointCloudBuilder, &K::point_cloud, &K::point_cloud_parameters>(
          "point_cloud", "depth image to points"),
      family<Mapper, &K::mapper, &K::mapper_parameters>("mapper", "points to occupancy"),
      family<CollisionChecker, &K::collision_check, &K::collision_check_parameters>(
          "collision_check", "looks along the path being flown"),
      switched_family<PathPlanner, SwitchedPlanner, &K::planner, &K::planner_parameters,
                      &KnobChoices::planner_kinds>("planner", "shortest path"),
      family<Smoother, &K::smoother, &K::smoother_parameters>("smoother",
                                                              "way-points to a trajectory"),
      family<PathTracker, &K::path_tracker, &K::path_tracker_parameters>(
          "path_tracker", "trajectory to set-points"),
      family<Localizer, &K::localizer, &K::localizer_parameters>(
          "localizer", "where the vehicle believes it is"),
      family<CoveragePlanner, &K::coverage, &K::coverage_parameters>(
          "coverage", "an area to a path over all of it"),
      family<Explorer, &K::explorer, &K::explorer_parameters>("explorer", "where to look next"),
      switched_family<Detector, SwitchedDetector, &K::detector, &K::detector_parameters,
                      &KnobChoices::detector_kinds>("detector", "people in colour images"),
      family<Tracker, &K::tracker, &K::tracker_parameters>("tracker",
                                                           "where what was detected goes"),
  };
}

/// `knobs.planner_kinds = "prm"`
std::string setting_of_kinds(const FamilyChoice& family, const Scenario& scenario) {
  return "knobs." + family.name + "_kinds = \"" + scenario.knobs.*family.kinds + "\"";
}

/// A kernel that is to be made.
struct WantedKernel {
  const FamilyChoice& family;
  const std::string& name;
  const ParameterValues& parameters;
};

/// @param must_be_usable  Else it only declares its knobs, and a file that it needs may be missing.
Result<std::unique_ptr<Kernel>> make_one(const WantedKernel& wanted,
                                         const Plugins& plugins,
                                         const FindModel& find_model,
                                         bool must_be_usable) {
  const auto& [family, name, parameters] = wanted;
  auto kernel = family.make(plugins, name);
  if (!kernel) {
    return unknown(family.name, name, "kernels");
  }
  const auto chosen = resolved(family.name + " \"" + name + "\"", kernel->parameters(), parameters);
  if (!chosen) {
    return chosen.error();
  }
  const Status configured = kernel->configure(*chosen, find_model);
  if (!configured && must_be_usable) {
    return configured.error();
  }
  return kernel;
}

Result<std::unique_ptr<Kernel>> make_all(const FamilyChoice& family,
                                         const Scenario& scenario,
                                         const FindModel& find_model,
                                         bool must_be_usable) {
  if (const Status known = check_kinds(family, scenario); !known) {
    return known.error();
  }
  const ParameterValues by_default;
  std::vector<KernelKind<Kernel>> kinds;
  for (const std::string& name : family.all_kinds(scenario)) {
    const auto& parameters = kinds.empty() ? scenario.kernels.*family.parameters : by_default;
    auto kernel =
        make_one({family, name, parameters}, scenario.plugins, find_model, must_be_usable);
    if (!kernel) {
      return kernel.error();
    }
    kinds.push_back({name, std::move(*kernel)});
  }
  return kinds.size() == 1 ? std::move(kinds.front().kernel) : family.join(std::move(kinds));
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

std::vector<std::string> FamilyChoice::all_kinds(const Scenario& scenario) const {
  std::vector<std::string> all{scenario.kernels.*kernel};
  std::istringstream others{kinds == nullptr ? "" : scenario.knobs.*kinds};
  for (std::string kind; std::getline(others, kind, ',');) {
    kind.erase(0, kind.find_first_not_of(' '));
    kind.erase(kind.find_last_not_of(' ') + 1);
    if (!kind.empty() && kind != "none" && std::find(all.begin(), all.end(), kind) == all.end()) {
      all.push_back(kind);
    }
  }
  return all;
}

Result<std::unique_ptr<Kernel>> make_kernel(const FamilyChoice& family,
                                            const Plugins& plugins,
                                            const KernelSettings& kernels,
                                            const FindModel& find_model) {
  return make_one({family, kernels.*family.kernel, kernels.*family.parameters}, plugins, find_model,
                  true);
}

Result<std::unique_ptr<Kernel>> make_switchable(const FamilyChoice& family,
                                                const Scenario& scenario,
                                                const FindModel& find_model) {
  return make_all(family, scenario, find_model, true);
}

Result<std::vector<KnobSpec>> knobs_of(const FamilyChoice& family, const Scenario& scenario) {
  const auto kernel = make_all(family, scenario, no_models, false);
  if (!kernel) {
    return kernel.error();
  }
  return (*kernel)->knobs();
}

Status check_kinds(const FamilyChoice& family, const Scenario& scenario, const std::string& place) {
  const std::vector<std::string> kinds = family.all_kinds(scenario);
  const std::vector<std::string> known = family.names(scenario.plugins);
  for (std::size_t i = 1; i < kinds.size(); ++i) {
    if (std::find(known.begin(), known.end(), kinds[i]) == known.end()) {
      return Error{ErrorCode::not_found,
                   setting_of_kinds(family, scenario) + place + " asks knob " + family.name +
                       ".kind for \"" + kinds[i] + "\", and it may choose among " + listed(known)};
    }
  }
  return Done{};
}

Status check_switch_prices(const FamilyChoice& family,
                           const Scenario& scenario,
                           const Platform& platform) {
  const std::vector<std::string> kinds = family.all_kinds(scenario);
  Work change;
  change.add("switches", 1.0);
  for (std::size_t i = 0; kinds.size() > 1 && i < kinds.size(); ++i) {
    const Duration price = platform.job_time(kinds[i], change, platform.frequencies().back());
    if (price <= Duration::zero()) {
      return Error{
          ErrorCode::invalid_input,
          setting_of_kinds(family, scenario) + " needs a price for each switch, and platform \"" +
              platform.name() + "\" has none to \"" + kinds[i] + "\"; add `switches` to [kernels." +
              kinds[i] + ".seconds_per] in the platform file, or leave \"" + kinds[i] + "\" out"};
    }
  }
  return Done{};
}

FindModel model_finder(const Scenario& scenario) {
  return [folder = scenario.detector.models_folder](const std::string& file) {
    return find_model(file, folder);
  };
}

}  // namespace flyball
