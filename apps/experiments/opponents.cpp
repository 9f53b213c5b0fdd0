// SPDX-License-Identifier: BSD-3-Clause
//
// mission_energy beside settings that were tuned for a world and beside rules of a few lines.

#include "experiments/framework/papers.h"

namespace flyball::experiments {
namespace {

constexpr const char* governor = "mission_energy";

struct Place {
  const char* sweep;
  const char* scenario;
  const char* title;
  std::vector<std::string> settings;
  std::vector<std::string> opponents;
};

std::vector<Place> places() {
  const std::vector<std::string> mixed = joined(quick_map(), {"world.length_m=600"});
  return {
      {"into_a_building",
       "delivery_outdoor_to_indoor",
       "from a field into a building",
       quick_map(),
       {"fixed_fine", "two_level_lattice", "gap_switch"}},
      {"mixed",
       "delivery_mixed",
       "buildings, crowds and slits",
       mixed,
       {"fixed_tuned_mixed", "two_level_tuned", "gap_switch"}},
      {"mixed_with_noise",
       "delivery_mixed",
       "the same with an RGB-D camera's noise",
       joined(mixed, {"camera.rgbd_noise=true"}),
       {"fixed_tuned_mixed", "two_level_tuned", "gap_switch_rgbd"}},
      {"mixed_with_a_quick_map",
       "delivery_mixed",
       "the same with the price of our own map",
       joined(quick_map_at_own_price(), {"world.length_m=600"}),
       {"fixed_tuned_mixed", "two_level_tuned", "gap_switch"}},
      {"congestion",
       "delivery_congestion",
       "blocks without doors",
       quick_map(),
       {"fixed_tuned", "two_level_tuned", "roborun_code"}},
  };
}

/// Maps that came later than the bound that was in force, over all flights of the point.
Measured late_percent(const Point& point) {
  double maps = 0.0;
  double late = 0.0;
  for (const Summary* flight : point.flights) {
    for (const LevelBounds& level : flight->latency_bounds) {
      maps += static_cast<double>(level.issued);
      late += static_cast<double>(level.late);
    }
  }
  return maps > 0.0 ? computed(100.0 * late / maps) : Measured{};
}

void compare(const Place& place, const Evidence& evidence, Findings& findings) {
  const std::string title{place.title};
  const Point ours = evidence.at(place.sweep, {}, governor);
  DotPlot plot{title + ": energy over that of mission_energy", {}};
  for (const std::string& opponent : place.opponents) {
    const Point theirs = evidence.at(place.sweep, {}, opponent);
    Claim energy{title + ": energy of " + opponent + " over that of mission_energy"};
    energy.neutral = 1.0;
    energy.ours = ratio(theirs, ours, flight_figure("energy_total_kj"));
    plot.values.push_back({opponent, energy.ours.value});
    findings.claims.insert(findings.claims.end(),
                           {energy, success_claim(title + ", " + opponent, theirs)});
  }
  Claim late{title + ", mission_energy: maps later than their bound (it aims at 5 %)", "%"};
  late.ours = late_percent(ours);
  findings.claims.insert(findings.claims.end(),
                         {success_claim(title + ", mission_energy", ours), late});
  findings.figures.push_back(
      {place.sweep,
       "Median ratio over pairs of flights with the same seed where both succeed; above 1 "
       "mission_energy takes less.",
       plot});
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const Place& place : places()) {
    compare(place, evidence, findings);
  }
  return findings;
}

}  // namespace

Experiment opponents() {
  Experiment experiment{
      "Is mission_energy better than tuned settings and than short rules?",
      "",
      "Deliveries with mission_energy, with the best single setting that a search found for each "
      "world on other seeds (fixed_tuned...), with a switch between two settings (two_level...), "
      "with a switch of forty lines that looks at gaps ahead (gap_switch...), and with RoboRun's "
      "published code. Stock OctoMap's work is charged where nothing else is said.",
      {},
      {},
      evaluate};
  for (const Place& place : places()) {
    ExperimentSweep sweep{place.sweep, place.scenario, place.settings, {}, {governor}};
    sweep.policies.insert(sweep.policies.end(), place.opponents.begin(), place.opponents.end());
    experiment.sweeps.push_back(sweep);
  }
  return experiment;
}

}  // namespace flyball::experiments
