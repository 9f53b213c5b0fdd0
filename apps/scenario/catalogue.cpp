// SPDX-License-Identifier: BSD-3-Clause
// tested-in: cli

#include "flyball/scenario/catalogue.h"

#include "flyball/flight/workload.h"
#include "flyball/governors/policy.h"
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
#include "flyball/scenario/files.h"
#include "flyball/scenario/plugins.h"
#include "flyball/sim/world.h"

#include <algorithm>
#include <set>

namespace flyball {

std::vector<KernelFamily> kernel_families() {
  const Registry& plugins = all_plugins();
  return {
      {"point_cloud", plugins.names<PointCloudBuilder>()},
      {"mapper", plugins.names<Mapper>()},
      {"collision_check", plugins.names<CollisionChecker>()},
      {"planner", plugins.names<PathPlanner>()},
      {"smoother", plugins.names<Smoother>()},
      {"path_tracker", plugins.names<PathTracker>()},
      {"localizer", plugins.names<Localizer>()},
      {"coverage", plugins.names<CoveragePlanner>()},
      {"explorer", plugins.names<Explorer>()},
      {"detector", plugins.names<Detector>()},
      {"tracker", plugins.names<Tracker>()},
  };
}

std::vector<std::string> world_names() {
  return all_plugins().names<WorldGenerator>();
}

std::vector<std::string> workload_names() {
  return all_plugins().names<Workload>();
}

std::vector<std::string> policy_names() {
  std::vector<std::string> names = shipped("presets");
  const std::vector<std::string> bare = all_plugins().names<Policy>();
  names.insert(names.end(), bare.begin(), bare.end());
  const std::set<std::string> sorted(names.begin(), names.end());
  return {sorted.begin(), sorted.end()};
}

}  // namespace flyball
