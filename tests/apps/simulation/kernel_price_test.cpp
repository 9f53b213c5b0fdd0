// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/kernel_price.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Work nothing(JobContext& /*job*/) {
  return {};
}

TEST(KernelPrice, every_node_that_costs_something_needs_a_price_and_each_that_has_none_is_named) {
  PlatformModel model;
  model.frequencies = {Hertz{1e9}};
  model.kernels["known"] = {};
  const ModeledPlatform platform{model};
  Scenario scenario;
  scenario.platform.name = "slate";
  Graph graph{"priced"};
  const auto add = [&graph](const std::string& name, const std::string& cost) {
    NodeSpec spec;
    spec.name = name;
    spec.cost = cost;
    spec.trigger = OnPeriod{std::chrono::seconds{1}};
    graph.node(std::move(spec), nothing);
  };
  add("free", "");
  add("priced", "known");
  EXPECT_TRUE(check_prices_of_nodes(scenario, platform, graph).ok());
  add("plan", "straight_line");
  add("smooth", "not_at_all");
  const Status refused = check_prices_of_nodes(scenario, platform, graph);
  ASSERT_FALSE(refused.ok());
  for (const char* words :
       {"platform \"slate\" has no price for kernel \"straight_line\" of node \"plan\"",
        "add [kernels.straight_line] to the platform file", "kernel \"not_at_all\" of node"}) {
    EXPECT_NE(refused.error().message.find(words), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace flyball
