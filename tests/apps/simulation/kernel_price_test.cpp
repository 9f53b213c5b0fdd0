// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/kernel_price.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Work nothing(JobContext& /*job*/) {
  return {};
}

/// A computer that knows one kernel.
ModeledPlatform slate() {
  PlatformModel model;
  model.frequencies = {Hertz{1e9}};
  model.kernels["known"] = {};
  return ModeledPlatform{model};
}

void add(Graph& graph, const std::string& name, const std::string& cost) {
  NodeSpec spec;
  spec.name = name;
  spec.cost = cost;
  spec.trigger = OnPeriod{std::chrono::seconds{1}};
  graph.node(std::move(spec), nothing);
}

TEST(KernelPrice, every_node_that_costs_something_needs_a_price_and_each_that_has_none_is_named) {
  const ModeledPlatform platform = slate();
  Scenario scenario;
  scenario.platform.name = "slate";
  Graph graph{"priced"};
  add(graph, "free", "");
  add(graph, "priced", "known");
  EXPECT_TRUE(check_prices_of_nodes(scenario, platform, graph).ok());
  add(graph, "plan", "straight_line");
  add(graph, "smooth", "not_at_all");
  const Status refused = check_prices_of_nodes(scenario, platform, graph);
  ASSERT_FALSE(refused.ok());
  for (const char* words :
       {"platform \"slate\" has no price for kernel \"straight_line\" of node \"plan\"",
        "add [kernels.straight_line] to the platform file", "kernel \"not_at_all\" of node"}) {
    EXPECT_NE(refused.error().message.find(words), std::string::npos) << refused.error().message;
  }
}

TEST(KernelPrice, nodes_that_may_move_to_the_edge_computer_need_a_price_there) {
  const ModeledPlatform edge = slate();
  Scenario scenario;
  scenario.edge.platform = "cloud";
  Graph graph{"priced"};
  add(graph, "map", "known");
  add(graph, "smooth", "stays_on_board");
  EXPECT_TRUE(check_prices_on_edge(scenario, edge, graph).ok());
  add(graph, "plan", "straight_line");
  add(graph, "explore", "nowhere");
  const Status refused = check_prices_on_edge(scenario, edge, graph);
  ASSERT_FALSE(refused.ok());
  for (const char* words :
       {"edge platform \"cloud\" has no price for kernel \"straight_line\" of node \"plan\", so",
        "its jobs would cost no time; add [kernels.straight_line] to the platform file",
        "kernel \"nowhere\" of node \"explore\""}) {
    EXPECT_NE(refused.error().message.find(words), std::string::npos) << refused.error().message;
  }
  EXPECT_EQ(refused.error().message.find("smooth"), std::string::npos) << refused.error().message;
}

TEST(KernelPrice, a_kernel_that_a_knob_chooses_needs_the_price_of_a_switch_on_the_edge_too) {
  Scenario scenario;
  scenario.edge.platform = "cloud";
  scenario.knobs.planner_kinds = "rrt,rrt_connect";
  const Status refused = check_prices_on_edge(scenario, slate(), Graph{"empty"});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("needs a price for each switch"), std::string::npos)
      << refused.error().message;
}

}  // namespace
}  // namespace flyball
