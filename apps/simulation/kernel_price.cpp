// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/kernel_price.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_edge.h"
#include "scenario/scenario_parameters.h"
#include <algorithm>
#include <vector>

namespace flyball {
namespace {

/// @param where  The computer as a sentence begins with it: `platform "jetson_tx2"`.
Status check_price_there(const std::string& where,
                         const Platform& platform,
                         const PricedKernel& kernel) {
  if (platform.knows(kernel.price)) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input, where + " has no price for " + kernel.who + ", so " +
                                             kernel.what + " would cost no time; " +
                                             kernel.other_means + "add [kernels." + kernel.price +
                                             "] to the platform file"};
}

/// Adds a sentence to `missing` where the node costs something that has no price there.
void look_at_node(const NodeSpec& node,
                  const std::string& where,
                  const Platform& platform,
                  std::vector<Error>& missing) {
  if (node.cost.empty()) {
    return;
  }
  const Status priced = check_price_there(
      where, platform,
      {node.cost, "kernel \"" + node.cost + "\" of node \"" + node.name + "\"", "its jobs", ""});
  if (!priced) {
    missing.push_back(priced.error());
  }
}

std::string on_board(const Scenario& scenario) {
  return "platform \"" + scenario.platform.name + "\"";
}

}  // namespace

Status check_price(const Scenario& scenario, const Platform& platform, const PricedKernel& kernel) {
  return check_price_there(on_board(scenario), platform, kernel);
}

Status check_prices_of_nodes(const Scenario& scenario,
                             const Platform& platform,
                             const Graph& graph) {
  std::vector<Error> missing;
  for (const Node& node : graph.nodes()) {
    look_at_node(node.spec, on_board(scenario), platform, missing);
  }
  return missing.empty() ? Status{Done{}} : Status{joined(missing)};
}

Status check_prices_on_edge(const Scenario& scenario, const Platform& edge, const Graph& graph) {
  std::vector<Error> missing;
  const std::string where = "edge platform \"" + scenario.edge.platform + "\"";
  const std::vector<KnobSpec> knobs = offload_knobs(scenario);
  for (const Node& node : graph.nodes()) {
    const bool may_move = std::any_of(knobs.begin(), knobs.end(), [&node](const KnobSpec& knob) {
      return knob.owner == node.spec.name;
    });
    if (may_move) {
      look_at_node(node.spec, where, edge, missing);
    }
  }
  for (const FamilyChoice& family : family_choices()) {
    if (const Status priced = check_switch_prices(family, scenario, edge); !priced) {
      missing.push_back(priced.error());
    }
  }
  return missing.empty() ? Status{Done{}} : Status{joined(missing)};
}

}  // namespace flyball
