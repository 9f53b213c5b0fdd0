// SPDX-License-Identifier: BSD-3-Clause
//
// What each part of mission_energy earns: the policy without it beside the whole one.

#include "experiments/framework/papers.h"
#include <array>
#include <vector>

namespace flyball::experiments {
namespace {

constexpr const char* whole = "mission_energy";

struct Part {
  const char* preset;
  const char* name;
};

constexpr std::array parts{
    Part{"mission_energy_without_resolution", "resolution"},
    Part{"mission_energy_without_range", "range"},
    Part{"mission_energy_without_clock", "clock"},
    Part{"mission_energy_without_gaps", "sight of narrow places"},
    Part{"mission_energy_without_declared_zones", "declared zones"},
};

struct Place {
  const char* sweep;
  const char* scenario;
  const char* title;
  std::vector<std::string> settings;
};

std::vector<Place> places() {
  const std::vector<std::string> mixed{"world.length_m=260", "world.buildings=1", "world.crowds=1",
                                       "world.slits=1"};
  return {
      {"into_a_building", "delivery_outdoor_to_indoor", "from a field into a building",
       quick_map()},
      {"forest", "delivery_forest", "forest", quick_map()},
      {"office", "delivery_office_as_built", "office as built", quick_map()},
      {"mixed", "delivery_mixed", "building, crowd and slit", joined(quick_map(), mixed)},
  };
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const Place& place : places()) {
    const Point all = evidence.at(place.sweep, {}, whole);
    Claim success{std::string{place.title} + ": flights with all parts that succeed", "%"};
    success.ours = success_percent(all);
    DotPlot plot{place.title, {}};
    for (const Part& part : parts) {
      const Point without = evidence.at(place.sweep, {}, part.preset);
      Claim claim{std::string{place.title} + ", without " + part.name +
                  ": energy over that with all parts"};
      claim.neutral = 1.0;
      claim.ours = ratio(without, all, flight_figure("energy_total_kj"));
      plot.values.push_back({part.name, claim.ours.value});
      findings.claims.push_back(claim);
      findings.claims.push_back(
          success_claim(std::string{place.title} + ", without " + part.name, without));
    }
    findings.claims.push_back(success);
    findings.figures.push_back(
        {place.sweep,
         "Energy without a part over that with all: median ratio of pairs of flights with the "
         "same seed. Above 1 the part saves energy.",
         plot});
  }
  return findings;
}

ExperimentSweep sweep_of(const Place& place) {
  ExperimentSweep sweep{place.sweep, place.scenario, place.settings, {}, {whole}};
  for (const Part& part : parts) {
    sweep.policies.emplace_back(part.preset);
  }
  return sweep;
}

}  // namespace

Experiment ablation() {
  Experiment experiment{
      "Which parts of mission_energy earn their keep?",
      "",
      "Deliveries with mission_energy and with the same policy without one of its parts. A part "
      "earns its keep where energy without it is higher with the whole interval, or where fewer "
      "flights succeed. flyball tournament --ablate mission_energy flies all of its parts, on "
      "worlds that are asked for.",
      {},
      {},
      evaluate};
  for (const Place& place : places()) {
    experiment.sweeps.push_back(sweep_of(place));
  }
  return experiment;
}

}  // namespace flyball::experiments
