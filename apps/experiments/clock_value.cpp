// SPDX-License-Identifier: BSD-3-Clause
//
// When a lower clock pays: our rule for the clock beside policies that leave it at the top, on
// vehicles of three sizes.

#include "experiments/framework/papers.h"
#include <array>

namespace flyball::experiments {
namespace {

/// A policy with our clock, and the same one at the top clock.
struct Pair {
  const char* with;
  const char* without;
};

constexpr std::array<Pair, 3> pairs{{{"fixed_fine_energy_clock", "fixed_fine"},
                                     {"two_level_energy_clock", "two_level"},
                                     {"mission_energy", "mission_energy_performance"}}};
constexpr std::array<const char*, 4> phases{"cruise", "hover", "scan", "perched"};
constexpr std::array<const char*, 3> airframes{"matrice_100", "spark", "tello"};

const char* scenario_of(const std::string& phase) {
  return phase == "cruise"  ? "delivery_open"
         : phase == "hover" ? "watch_hovering"
         : phase == "scan"  ? "scanning_farm"
                            : "watch_perched";
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const char* phase : phases) {
    DotPlot plot{std::string{phase} + ": energy with our clock over that at the top clock", {}};
    for (const char* airframe : airframes) {
      for (const Pair& pair : pairs) {
        const Measured measured =
            ratio(evidence.at(phase, {airframe}, pair.with),
                  evidence.at(phase, {airframe}, pair.without), flight_figure("energy_total_kj"));
        const std::string name = std::string{airframe} + ", " + pair.without;
        plot.values.push_back({name, measured.value});
        Claim claim{std::string{phase} + ", " + name +
                    ": energy with our clock over the top clock"};
        claim.ours = measured;
        findings.claims.push_back(claim);
      }
    }
    findings.figures.push_back(
        {phase, "Median ratio over pairs of flights with the same seed.", plot});
  }
  return findings;
}

}  // namespace

Experiment clock_value() {
  Experiment experiment{
      "When does a lower clock pay?",
      "",
      "Three policies with our rule for the clock (energy_clock, which mission_energy contains) "
      "against the same policies at the top clock, in four phases of a mission, on vehicles of 252 "
      "W, "
      "67 W and 20 W of hover power; speed limit 4 m/s, physics in steps of 4 ms.",
      {},
      {},
      evaluate};
  for (const char* phase : phases) {
    ExperimentSweep sweep{phase,
                          scenario_of(phase),
                          {"mission.max_speed_m_s=4", "vehicle.physics_step_s=0.004"},
                          {{"vehicle.airframe", {airframes.begin(), airframes.end()}}},
                          {}};
    for (const Pair& pair : pairs) {
      sweep.policies.insert(sweep.policies.end(), {pair.with, pair.without});
    }
    sweep.most_seeds = 3;
    experiment.sweeps.push_back(sweep);
  }
  return experiment;
}

}  // namespace flyball::experiments
