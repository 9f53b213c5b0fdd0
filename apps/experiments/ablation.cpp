// SPDX-License-Identifier: BSD-3-Clause
//
// What each part of mission_energy earns: the policy without it beside the whole one.

#include "experiments/framework/papers.h"
#include <array>

namespace flyball::experiments {
namespace {

constexpr const char* whole = "mission_energy";

struct Part {
  const char* preset;
  const char* name;
};

constexpr std::array<Part, 5> parts{{
    {"mission_energy_without_resolution", "resolution"},
    {"mission_energy_without_range", "range"},
    {"mission_energy_without_clock", "clock"},
    {"mission_energy_without_gaps", "sight of narrow places"},
    {"mission_energy_without_declared_zones", "declared zones"},
}};

struct Place {
  const char* sweep;
  const char* scenario;
  const char* title;
  std::vector<std::string> settings;
};

std::vector<Place> places() {
  return {
      {"into_a_building", "delivery_outdoor_to_indoor", "from a field into a building", {}},
      {"forest", "delivery_forest", "forest", {}},
      {"mixed",
       "delivery_mixed",
       "building, crowd and slit",
       {"world.length_m=260", "world.buildings=1", "world.crowds=1", "world.slits=1"}},
  };
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const Place& place : places()) {
    const Point all = evidence.at(place.sweep, {}, whole);
    Claim success{std::string{place.title} + ": flights with all parts that succeed", "%"};
    success.ours = success_percent(all);
    DotPlot plot{std::string{place.title} + ": energy without a part over energy with all", {}};
    for (const Part& part : parts) {
      const Point without = evidence.at(place.sweep, {}, part.preset);
      Claim claim{std::string{place.title} + ", without " + part.name +
                  ": energy over that with all parts"};
      claim.neutral = 1.0;
      claim.ours = ratio(without, all, flight_figure("energy_total_kj"));
      plot.values.push_back({part.name, claim.ours.value});
      findings.claims.push_back(claim);
      Claim flown{std::string{place.title} + ", without " + part.name + ": flights that succeed",
                  "%"};
      flown.ours = success_percent(without);
      findings.claims.push_back(flown);
    }
    findings.claims.push_back(success);
    findings.figures.push_back(
        {place.sweep,
         "Median ratio over pairs of flights with the same seed; above 1 the part "
         "saves energy.",
         plot});
  }
  return findings;
}

ExperimentSweep sweep_of(const Place& place) {
  ExperimentSweep sweep{
      place.sweep, place.scenario, joined(quick_map(), place.settings), {}, {whole}};
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
