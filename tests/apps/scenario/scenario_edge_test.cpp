// SPDX-License-Identifier: BSD-3-Clause
#include "scenario/scenario_edge.h"

#include "flyball/scenario/knobs.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::string errors_of(const std::vector<std::string>& overrides) {
  const auto read = load_scenario("mapping_office", overrides);
  std::string all;
  if (const auto* errors = std::get_if<std::vector<Error>>(&read)) {
    for (const Error& error : *errors) {
      all += error.message + "\n";
    }
  }
  return all;
}

Scenario loaded(const std::vector<std::string>& overrides) {
  return std::get<LoadedScenario>(load_scenario("mapping_office", overrides)).scenario;
}

TEST(ScenarioEdge, by_default_there_is_none_and_no_knob_for_it) {
  const Scenario scenario = loaded({});
  EXPECT_FALSE(make_edge(scenario).value().has_value());
  EXPECT_TRUE(offload_knobs(scenario).empty());
  EXPECT_FALSE(flight_settings(scenario).has_edge);
}

TEST(ScenarioEdge, is_the_named_platform_at_its_top_behind_the_link) {
  const Scenario scenario = loaded({"edge.platform=jetson_tx2", "edge.speed_factor=3",
                                    "edge.bandwidth_mbit_s=100", "edge.latency_s=0.004",
                                    "edge.jitter_s=0.001", "edge.loss=0.05", "edge.timeout_s=0.3"});
  const EdgeModel edge = make_edge(scenario).value().value();
  EXPECT_EQ(edge.platform->name(), "jetson_tx2");
  EXPECT_EQ(edge.point, (OperatingPoint{4, Hertz{2035.2e6}}));
  EXPECT_EQ(edge.speed_factor, 3.0);
  EXPECT_EQ(edge.link.bandwidth_bit_s, 1e8);
  EXPECT_EQ(edge.link.latency, from_seconds(0.004));
  EXPECT_EQ(edge.link.jitter, from_seconds(0.001));
  EXPECT_EQ(edge.link.loss, 0.05);
  EXPECT_EQ(edge.link.timeout, from_seconds(0.3));
  EXPECT_TRUE(flight_settings(scenario).has_edge);
}

TEST(ScenarioEdge, knobs_begin_where_the_scenario_puts_the_nodes) {
  const Scenario scenario = loaded({"edge.platform=jetson_tx2", "offload.explore=1"});
  PlatformModel platform;
  platform.max_cores = 4;
  platform.frequencies = {Hertz{2035.2e6}};
  const auto specs = standard_knobs(scenario, ModeledPlatform{platform});
  ASSERT_TRUE(specs.ok()) << specs.error().message;
  const KnobSettings knobs{*specs};
  EXPECT_EQ(knobs.value("offload.explore"), 1.0);
  EXPECT_EQ(knobs.value("offload.plan"), 0.0);
  EXPECT_EQ(knobs.spec("offload.map")->labels, (std::vector<std::string>{"onboard", "edge"}));
}

TEST(ScenarioEdge, nodes_move_only_where_there_is_an_edge_computer) {
  const std::string said = errors_of({"offload.plan=1"});
  EXPECT_NE(said.find("offload.plan = 1 (--set) needs an edge computer; set edge.platform"),
            std::string::npos)
      << said;
}

TEST(ScenarioEdge, a_platform_that_there_is_not_is_named) {
  const std::string said = errors_of({"edge.platform=cray"});
  EXPECT_NE(said.find("edge.platform = \"cray\" (--set)"), std::string::npos) << said;
}

TEST(ScenarioEdge, survives_being_written_and_read) {
  const Scenario scenario = loaded({"edge.platform=jetson_tx2", "edge.loss=0.05", "offload.map=1"});
  const std::string text = to_toml(scenario);
  EXPECT_NE(text.find("[edge]\nplatform = \"jetson_tx2\""), std::string::npos) << text;
  EXPECT_NE(text.find("loss = 0.05"), std::string::npos) << text;
  EXPECT_NE(text.find("[offload]\nplan = 0\nmap = 1"), std::string::npos) << text;
}

}  // namespace
}  // namespace flyball
