// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/plugins.h"

#include "flyball/flight/workload.h"
#include "flyball/governors/policy.h"
#include "flyball/kernels/mapper.h"
#include "flyball/scenario/catalogue.h"
#include "flyball/sim/world.h"
#include "flyball/simulation/mission.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Its graph has one node, by whose name it is known.
class OneNode final : public Workload {
 public:
  explicit OneNode(std::string node) : node_{std::move(node)} {}
  void build(Graph& graph, const FlightParts&) override {
    NodeSpec spec;
    spec.name = node_;
    spec.trigger = OnPeriod{std::chrono::milliseconds{100}, std::chrono::milliseconds{100}};
    graph.node(std::move(spec), [](JobContext&) { return Work{}; });
  }

 private:
  std::string node_;
};

/// A workload "mine" with this node.
Scenario mine(const std::string& node) {
  Scenario scenario;
  scenario.mission.workload = "mine";
  scenario.plugins = Plugins{}.with([&node](Registry& registry) {
    registry.add<Workload>("mine", [node] { return std::make_unique<OneNode>(node); });
  });
  return scenario;
}

bool draws(const Scenario& scenario, const std::string& node) {
  const auto drawn = describe_graph(scenario, false);
  EXPECT_TRUE(drawn.ok()) << drawn.error().message;
  return drawn && drawn->find(node) != std::string::npos;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// All names of all interfaces that a scenario uses.
std::vector<std::vector<std::string>> all_names(const Plugins& plugins) {
  std::vector<std::vector<std::string>> names{world_names(plugins), workload_names(plugins),
                                              policy_names(plugins)};
  for (const KernelFamily& family : kernel_families(plugins)) {
    names.push_back(family.kernels);
  }
  return names;
}

TEST(Plugins, are_those_that_are_compiled_in) {
  const Plugins plugins;
  EXPECT_NE(plugins.make<Mapper>("flyball"), nullptr);
  EXPECT_NE(plugins.make<Policy>("density"), nullptr);
  EXPECT_NE(plugins.make<WorldGenerator>("forest"), nullptr);
  EXPECT_NE(plugins.make<Workload>("package_delivery"), nullptr);
  EXPECT_EQ(plugins.make<Workload>("mine"), nullptr);
  EXPECT_TRUE(plugins.libraries().empty());
}

TEST(Plugins, of_two_missions_in_one_process_do_not_see_each_other) {
  const Scenario first = mine("first_node");
  const Scenario second = mine("second_node");
  EXPECT_TRUE(draws(first, "first_node"));
  EXPECT_TRUE(draws(second, "second_node"));
  EXPECT_FALSE(draws(first, "second_node"));
  EXPECT_FALSE(draws(second, "first_node"));
  Scenario shipped = first;
  shipped.plugins = {};
  EXPECT_EQ(describe_graph(shipped, false).error().message,
            "no workload \"mine\"; try: flyball list workloads");
}

TEST(Plugins, that_are_shipped_never_change) {
  const Plugins before;
  const auto names = all_names(before);
  const Scenario scenario = mine("a_node");
  EXPECT_TRUE(has(workload_names(scenario.plugins), "mine"));
  EXPECT_EQ(all_names(before), names);
  EXPECT_EQ(all_names(Plugins{}), names);
}

TEST(Plugins, can_be_added_to_those_that_were_added) {
  const Plugins both = mine("a_node").plugins.with([](Registry& registry) {
    registry.add<Workload>("another", [] { return std::make_unique<OneNode>("another_node"); });
  });
  const std::vector<std::string> names = workload_names(both);
  EXPECT_TRUE(has(names, "mine") && has(names, "another") && has(names, "package_delivery"));
}

TEST(Plugins, are_what_the_names_in_a_file_stand_for) {
  const std::vector<std::string> settings{"mission.workload=mine"};
  const auto loaded = load_scenario("delivery_open", settings, mine("a_node").plugins);
  ASSERT_TRUE(std::holds_alternative<LoadedScenario>(loaded));
  EXPECT_TRUE(draws(std::get<LoadedScenario>(loaded).scenario, "a_node"));
  EXPECT_TRUE(std::holds_alternative<std::vector<Error>>(load_scenario("delivery_open", settings)));
}

TEST(PluginsDeathTest, with_a_name_that_is_taken_are_a_programming_error) {
  EXPECT_DEATH((void)mine("a_node").plugins.with([](Registry& registry) {
    registry.add<Workload>("mine", [] { return std::make_unique<OneNode>("a_node"); });
  }),
               "\"mine\" is registered twice");
}

}  // namespace
}  // namespace flyball
