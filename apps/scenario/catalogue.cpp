// SPDX-License-Identifier: BSD-3-Clause
// tested-in: cli

#include "flyball/scenario/catalogue.h"

#include "flyball/flight/workload.h"
#include "flyball/governors/policy.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/plugins.h"
#include "flyball/sim/world.h"

#include "scenario/kernel_choice.h"
#include <algorithm>
#include <set>

namespace flyball {

std::vector<KernelFamily> kernel_families() {
  std::vector<KernelFamily> families;
  for (const FamilyChoice& family : family_choices()) {
    families.push_back({family.name, family.names()});
  }
  return families;
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
