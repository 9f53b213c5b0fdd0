// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/kernel_price.h"

#include "scenario/scenario_parameters.h"
#include <vector>

namespace flyball {

Status check_price(const Scenario& scenario, const Platform& platform, const PricedKernel& kernel) {
  if (platform.knows(kernel.price)) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               "platform \"" + scenario.platform.name + "\" has no price for " + kernel.who +
                   ", so " + kernel.what + " would cost no time; " + kernel.other_means +
                   "add [kernels." + kernel.price + "] to the platform file"};
}

Status check_prices_of_nodes(const Scenario& scenario,
                             const Platform& platform,
                             const Graph& graph) {
  std::vector<Error> missing;
  for (const Node& node : graph.nodes()) {
    const NodeSpec& spec = node.spec;
    if (spec.cost.empty()) {
      continue;
    }
    const Status priced = check_price(
        scenario, platform,
        {spec.cost, "kernel \"" + spec.cost + "\" of node \"" + spec.name + "\"", "its jobs", ""});
    if (!priced) {
      missing.push_back(priced.error());
    }
  }
  return missing.empty() ? Status{Done{}} : Status{joined(missing)};
}

}  // namespace flyball
