// SPDX-License-Identifier: BSD-3-Clause
// tested-in: cli

#include "flyball/scenario/catalogue.h"

#include "flyball/flight/workload.h"
#include "flyball/governors/policy.h"
#include "flyball/scenario/files.h"
#include "flyball/sim/world.h"

#include "scenario/kernel_choice.h"
#include <algorithm>
#include <set>

namespace flyball {

std::vector<KernelFamily> kernel_families(const Plugins& plugins) {
  std::vector<KernelFamily> families;
  for (const FamilyChoice& family : family_choices()) {
    families.push_back({family.name, family.names(plugins)});
  }
  return families;
}

std::vector<std::string> world_names(const Plugins& plugins) {
  return plugins.names<WorldGenerator>();
}

std::vector<std::string> workload_names(const Plugins& plugins) {
  return plugins.names<Workload>();
}

std::vector<std::string> policy_names(const Plugins& plugins) {
  std::vector<std::string> names = shipped("presets");
  const std::vector<std::string> bare = plugins.names<Policy>();
  names.insert(names.end(), bare.begin(), bare.end());
  const std::set<std::string> sorted(names.begin(), names.end());
  return {sorted.begin(), sorted.end()};
}

}  // namespace flyball
