// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_edge.h"

#include "flyball/scenario/catalogue.h"
#include "flyball/scenario/shipped_platform.h"

#include "scenario/scenario_keys.h"
#include <array>
#include <memory>
#include <string>
#include <utility>

namespace flyball {
namespace {

struct OffloadChoice {
  const char* node;
  int OffloadSettings::*place;
};

/// The nodes that may move: what they read and write fits through a link.
constexpr std::array<OffloadChoice, 4> choices{{
    {"plan", &OffloadSettings::plan},
    {"map", &OffloadSettings::map},
    {"detect", &OffloadSettings::detect},
    {"explore", &OffloadSettings::explore},
}};

std::string key_of(const OffloadChoice& choice) {
  return std::string{"offload."} + choice.node;
}

}  // namespace

bool has_edge(const Scenario& scenario) {
  return scenario.edge.platform != "none";
}

std::vector<ScenarioField> edge_fields() {
  constexpr auto in = &Scenario::edge;
  constexpr auto moved = &Scenario::offload;
  using E = EdgeSettings;
  using O = OffloadSettings;
  const std::string place = "0: on board until a policy says otherwise; 1: on the edge computer";
  return {
      {"edge.platform", &at<in, &E::platform>, 0, 0,
       "a computer that is not on board, as a platform; none: there is none"},
      {"edge.speed_factor", &at<in, &E::speed_factor>, 0.01, 1000,
       "it computes so many times faster than that platform at its highest clock"},
      {"edge.bandwidth_mbit_s", &at<in, &E::bandwidth_mbit_s>, 0.001, 1e6,
       "of the link, in each direction"},
      {"edge.latency_s", &at<in, &E::latency_s>, 0, 10, "of the link, one way"},
      {"edge.jitter_s", &at<in, &E::jitter_s>, 0, 10,
       "a message takes up to so much longer, evenly distributed"},
      {"edge.loss", &at<in, &E::loss>, 0, 0.9, "share of the packets that are lost"},
      {"edge.timeout_s", &at<in, &E::timeout_s>, 0.001, 10,
       "after so long lost packets are sent again"},
      {"edge.radio_send_w", &at<in, &E::radio_send_w>, 0, 100, "power of the radio while it sends"},
      {"edge.radio_receive_w", &at<in, &E::radio_receive_w>, 0, 100, "while it receives"},
      {"edge.radio_idle_w", &at<in, &E::radio_idle_w>, 0, 100, "at all other times"},
      {"offload.plan", &at<moved, &O::plan>, 0, 1, place},
      {"offload.map", &at<moved, &O::map>, 0, 1, place},
      {"offload.detect", &at<moved, &O::detect>, 0, 1, place},
      {"offload.explore", &at<moved, &O::explore>, 0, 1, place},
  };
}

std::vector<Error> check_edge(const Scenario& scenario, const GivenValues& given) {
  std::vector<Error> errors;
  for (const OffloadChoice& choice : choices) {
    if (scenario.offload.*choice.place != 0 && !has_edge(scenario)) {
      errors.push_back({ErrorCode::invalid_input,
                        key_of(choice) + " = 1" + place_of(key_of(choice), given) +
                            " needs an edge computer; set edge.platform, for example to \"" +
                            scenario.platform.name + "\""});
    }
  }
  if (has_edge(scenario)) {
    if (const auto platform = find_platform(scenario.edge.platform); !platform) {
      errors.push_back({platform.error().code, "edge.platform = \"" + scenario.edge.platform +
                                                   "\"" + place_of("edge.platform", given) + ": " +
                                                   platform.error().message});
    }
  }
  return errors;
}

std::vector<KnobSpec> offload_knobs(const Scenario& scenario) {
  std::vector<KnobSpec> knobs;
  if (!has_edge(scenario)) {
    return knobs;
  }
  for (const OffloadChoice& choice : choices) {
    KnobSpec spec{key_of(choice),
                  "place",
                  choice.node,
                  {0.0, 1.0},
                  0.0,
                  1.0,
                  0.0,
                  "where the next jobs of this node run"};
    spec.labels = {"onboard", "edge"};
    knobs.push_back(std::move(spec));
  }
  return knobs;
}

Result<std::optional<EdgeModel>> make_edge(const Scenario& scenario) {
  if (!has_edge(scenario)) {
    return std::optional<EdgeModel>{};
  }
  auto platform = find_platform(scenario.edge.platform);
  if (!platform) {
    return platform.error();
  }
  const EdgeSettings& of = scenario.edge;
  EdgeModel edge;
  edge.point = {platform->max_cores, platform->frequencies.back()};
  edge.platform = std::make_shared<const ModeledPlatform>(std::move(*platform));
  edge.speed_factor = of.speed_factor;
  edge.link = {1e6 * of.bandwidth_mbit_s, from_seconds(of.latency_s), from_seconds(of.jitter_s),
               of.loss, from_seconds(of.timeout_s)};
  edge.seed = scenario.seed;
  return std::optional{std::move(edge)};
}

}  // namespace flyball
