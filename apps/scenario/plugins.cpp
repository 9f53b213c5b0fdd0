// SPDX-License-Identifier: BSD-3-Clause
// tested-in: cli
#include "flyball/scenario/plugins.h"

#include "flyball/flight/workload.h"
#include "flyball/kernels/kernels.h"
#include "flyball/policies/policies.h"
#include "flyball/sim/worlds.h"

namespace flyball {
namespace {

Registry& plugins() {
  static Registry registry = [] {
    Registry all;
    register_kernels(all);
    register_policies(all);
    register_worlds(all);
    register_workloads(all);
    return all;
  }();
  return registry;
}

}  // namespace

const Registry& all_plugins() {
  return plugins();
}

void add_plugins(const std::function<void(Registry&)>& add) {
  add(plugins());
}

}  // namespace flyball
