// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// That no kernel flies without a price in the platform file, because it would take no time, on
/// board or on the edge computer.

#include "flyball/runtime/graph.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/result.h"
#include "flyball/scenario/scenario.h"

#include <string>

namespace flyball {

struct PricedKernel {
  std::string price{};        ///< The name of its price: `[kernels.NAME]` of the platform file.
  std::string who{};          ///< What the scenario names, such as `detector "hog"`.
  std::string what{};         ///< What would cost no time.
  std::string other_means{};  ///< Than to add the price, as in "set ..., or "; may be empty.
};

/// @error The platform has no such price.
[[nodiscard]] Status check_price(const Scenario& scenario,
                                 const Platform& platform,
                                 const PricedKernel& kernel);

/// The same for all nodes of a graph that the modeled computer runs, once it is built. The checks
/// of single kernels come before it, because they can name another way out.
/// @error The platform has no price for some nodes: one sentence for each of them.
[[nodiscard]] Status check_prices_of_nodes(const Scenario& scenario,
                                           const Platform& platform,
                                           const Graph& graph);

/// The same of the edge computer, for the nodes that may move there in flight and for the kernels
/// that a knob chooses among.
/// @error As `check_prices_of_nodes`, and the platform has no price for a switch.
[[nodiscard]] Status check_prices_on_edge(const Scenario& scenario,
                                          const Platform& edge,
                                          const Graph& graph);

}  // namespace flyball
