// SPDX-License-Identifier: BSD-3-Clause
//
// Who takes the power: MAVBench has 300 to 400 W for the rotors, about 10 W for the computer, under
// 5 %.

#include "experiments/framework/papers.h"

namespace flyball::experiments {
namespace {

constexpr const char* in_text = "text on power";

std::optional<double> rotor_w(const Summary& flight) {
  return flight.mission_time_s > 0.0 ? std::optional{flight.energy_rotor_j / flight.mission_time_s}
                                     : std::nullopt;
}

std::optional<double> computer_w(const Summary& flight) {
  return flight.mission_time_s > 0.0
             ? std::optional{flight.energy_computer_j / flight.mission_time_s}
             : std::nullopt;
}

std::optional<double> computer_percent(const Summary& flight) {
  const double all_j = flight.energy_total_j();
  return all_j > 0.0 ? std::optional{100.0 * flight.energy_computer_j / all_j} : std::nullopt;
}

// Causes are tested where a claim does not hold.

/// Below the paper's least rotor power.
bool is_light(const std::string& mission) {
  return mission == "scanning" || mission == "mapping" || mission == "search";
}

/// Below the paper's power of the computer: no detector runs.
bool has_idle_cores(const std::string& mission) {
  return mission == "scanning" || mission == "delivery" || mission == "mapping";
}

/// Failed flights take power, too.
Point flown(const Evidence& evidence, const std::string& sweep) {
  Point point = evidence.at(sweep, {});
  point.counts_failed = true;
  return point;
}

void add_claims(const Evidence& evidence, const std::string& mission, Findings& findings) {
  const Point point = flown(evidence, mission);
  Claim share{mission + ": computer's share", "%"};
  share.paper = PaperValue{5.0, in_text};
  share.match = PaperMatch::at_most;
  share.ours = median(point, computer_percent);
  Claim computer{mission + ": computer", "W"};
  computer.paper = PaperValue{10.0, in_text};
  computer.ours = median(point, computer_w);
  Claim least{mission + ": rotors, at least", "W"};
  least.paper = PaperValue{300.0, in_text};
  least.match = PaperMatch::at_least;
  least.slack = 0.5;  // Watts are printed without decimals.
  least.ours = median(point, rotor_w);
  Claim most = least;
  most.what = mission + ": rotors, at most";
  most.paper = PaperValue{400.0, in_text};
  most.match = PaperMatch::at_most;
  if (is_light(mission)) {
    least.causes.push_back({"with the delivery's payload of .5 kg",
                            median(flown(evidence, mission + "_loaded"), rotor_w)});
  }
  if (has_idle_cores(mission)) {
    computer.causes.push_back({"three of the four cores always busy (a co-runner)",
                               median(flown(evidence, mission + "_busy"), computer_w)});
  }
  findings.claims.insert(findings.claims.end(), {share, computer, least, most});
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  DotPlot rotors{"rotors, W", {}};
  DotPlot computer{"computer, W", {}};
  for (const PaperMission& mission : paper_missions()) {
    add_claims(evidence, mission.name, findings);
    const Point point = flown(evidence, mission.name);
    rotors.values.push_back({mission.name, median(point, rotor_w).value});
    computer.values.push_back({mission.name, median(point, computer_w).value});
  }
  const char* caption = "Energy over mission time; median over the flights.";
  findings.figures.push_back({"rotors", caption, rotors});
  findings.figures.push_back({"computer", caption, computer});
  return findings;
}

}  // namespace

Experiment power_breakdown() {
  Experiment experiment{
      "How much of the power does the computer take?",
      std::string{mavbench} + ", text on power",
      "The five missions at 4 cores and 2.0352 GHz with a fine map (fixed_fine). Mean power is "
      "energy "
      "over mission time, so that it contains take-off and landing.",
      {"The computer's power model is estimated from published rail powers of the TX2; the rotors' "
       "is eq. 1 of the paper for the Matrice 100."},
      {},
      evaluate};
  for (const PaperMission& mission : paper_missions()) {
    const std::vector<std::string> settings = joined(mission.settings, fast_corner());
    experiment.sweeps.push_back({mission.name, mission.scenario, settings, {}, {"fixed_fine"}});
    const auto add_cause = [&](const char* name, const std::vector<std::string>& change) {
      experiment.sweeps.push_back(
          {mission.name + name, mission.scenario, joined(settings, change), {}, {"fixed_fine"}});
      experiment.sweeps.back().most_seeds = 1;
    };
    if (has_idle_cores(mission.name)) {
      add_cause("_busy", {"events.1.kind=co_runner", "events.1.at_s=0", "events.1.cores=3"});
    }
    if (is_light(mission.name)) {
      add_cause("_loaded", {"vehicle.payload_kg=0.5"});
    }
  }
  return experiment;
}

}  // namespace flyball::experiments
