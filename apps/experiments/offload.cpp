// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's cloud study: an edge computer plans while an office is mapped.

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"

namespace flyball::experiments {
namespace {

constexpr const char* links = "links";
constexpr const char* losses = "losses";
constexpr const char* onboard = "onboard";
constexpr const char* time_s = "mission_time_s";

/// All planning on an edge computer, which the paper's study has three times as fast.
std::vector<std::string> planned_afar(const std::string& speed_factor = "3") {
  return {"edge.platform=jetson_tx2", "edge.speed_factor=" + speed_factor, "offload.explore=1",
          "offload.plan=1"};
}

Measured over_onboard(const Evidence& evidence, const Point& over) {
  return ratio(over, evidence.at(onboard, {}), flight_figure(time_s));
}

Claim claim_of(const std::string& what, const Measured& ours) {
  Claim claim{what};
  claim.ours = ours;
  claim.neutral = 1.0;
  return claim;
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  Claim paper = claim_of("mission time with planning on the edge, 1 Gb/s, over on board",
                         over_onboard(evidence, evidence.at(links, {"1000"})));
  paper.paper = paper_change(-50.0, "study of offloading, 3-D mapping");
  paper.causes = {
      {"planning on the edge takes no time", over_onboard(evidence, evidence.at("no_time", {}))},
      {"the map is made on the edge, too", over_onboard(evidence, evidence.at("map_too", {}))}};
  findings.claims.push_back(paper);
  for (const char* bandwidth : {"100", "10", "1"}) {
    findings.claims.push_back(claim_of(std::string{"the same at "} + bandwidth + " Mb/s",
                                       over_onboard(evidence, evidence.at(links, {bandwidth}))));
  }
  findings.claims.push_back(claim_of("the same at 100 Mb/s with 5 % loss",
                                     over_onboard(evidence, evidence.at(losses, {"0.05"}))));
  PlotOf wanted{links, "mission time, s", flight_figure(time_s), {"bandwidth, Mb/s", {}}};
  findings.figures.push_back(
      {"bandwidth", counts_text(evidence, wanted), line_plot_of(evidence, wanted)});
  wanted = {
      losses, "mission time at 100 Mb/s, s", flight_figure(time_s), {"share of packets lost", {}}};
  findings.figures.push_back(
      {"loss", counts_text(evidence, wanted), line_plot_of(evidence, wanted)});
  return findings;
}

}  // namespace

Experiment offload() {
  const std::string scenario = "mapping_office";
  const std::vector<std::string> afar = planned_afar();
  return {
      "What is a link to an edge computer worth?",
      std::string{mavbench} + ", study of offloading",
      "An office is mapped while explorer and planner run on a computer that is three times as "
      "fast, behind a link; one way takes 1 ms. Messages are as large as their content: a map, for "
      "example, takes 2.3 bits for each known cell. Lost packets are sent again after .2 s.",
      {},
      {{onboard, scenario, {}, {}, {"fixed_fine"}},
       {links,
        scenario,
        afar,
        {{"edge.bandwidth_mbit_s", {"1000", "100", "10", "1"}}},
        {"fixed_fine"}},
       {losses,
        scenario,
        joined(afar, {"edge.bandwidth_mbit_s=100"}),
        {{"edge.loss", {"0.01", "0.05", "0.2"}}},
        {"fixed_fine"}},
       with_few_seeds({"no_time", scenario, planned_afar("1000"), {}, {"fixed_fine"}}),
       with_few_seeds({"map_too", scenario, joined(afar, {"offload.map=1"}), {}, {"fixed_fine"}})},
      evaluate};
}

}  // namespace flyball::experiments
