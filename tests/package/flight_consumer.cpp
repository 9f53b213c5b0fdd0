// SPDX-License-Identifier: BSD-3-Clause
//
// Asks the installed library what it can fly: everything behind the kernels and the simulator is
// linked, and its shipped data is found in the prefix.

#include <cstdio>

#include <flyball/governors/policy.h>
#include <flyball/kernels/mapper.h>
#include <flyball/kernels/path_planner.h>
#include <flyball/scenario/plugins.h>
#include <flyball/scenario/scenario.h>

int main() {
  const flyball::Plugins plugins;
  const bool has_kernels = plugins.make<flyball::Mapper>("octomap") != nullptr &&
                           plugins.make<flyball::PathPlanner>("rrt_connect") != nullptr;
  const bool has_policies = !plugins.names<flyball::Policy>().empty();
  if (!has_kernels || !has_policies) {
    return 1;
  }
  const auto loaded = flyball::load_scenario("delivery_forest", {});
  if (const auto* errors = std::get_if<std::vector<flyball::Error>>(&loaded)) {
    std::puts(errors->front().message.c_str());
    return 1;
  }
  return 0;
}
