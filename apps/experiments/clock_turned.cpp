// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a mission can need a clock that is turned in flight: one that flies and watches, at every
// fixed clock of the computer and with policies that turn it.

#include "experiments/framework/papers.h"
#include <array>
#include <cstdio>

namespace flyball::experiments {
namespace {

/// A policy that turns the clock, and the same one that leaves it as it is set.
struct Pair {
  const char* turned;
  const char* fixed;
};

constexpr std::array<Pair, 2> pairs{
    {{"mission_energy", "mission_energy_fixed_clock"}, {"two_level_energy_clock", "two_level"}}};

/// All clocks of the TX2.
std::vector<std::string> clocks_hz() {
  return {"0.3456e9", "0.4992e9", "0.6528e9", "0.8064e9", "0.96e9",   "1.1136e9",
          "1.2672e9", "1.4208e9", "1.5744e9", "1.728e9",  "1.8816e9", "2.0352e9"};
}

std::string ghz(const std::string& clock_hz) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f GHz", std::stod(clock_hz) * 1e-9);
  return text;
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const Pair& pair : pairs) {
    const Point turned = evidence.at("turned", {}, pair.turned);
    const std::string best_hz = best_in_hindsight(evidence, "fixed", clocks_hz(), pair.fixed);
    const auto over = [&](const std::string& clock_hz) {
      return ratio(turned, evidence.at("fixed", {clock_hz}, pair.fixed),
                   flight_figure("energy_total_kj"));
    };
    Claim least{std::string{pair.turned} + ": energy over that at the best fixed clock, " +
                ghz(best_hz)};
    least.ours = over(best_hz);
    findings.claims.push_back(least);
    findings.claims.push_back(success_claim(pair.turned, turned));
    findings.claims.push_back(success_claim(pair.fixed + (" at " + ghz(best_hz)),
                                            evidence.at("fixed", {best_hz}, pair.fixed)));
    DotPlot plot{std::string{pair.turned} + ": energy over that at a fixed clock", {}};
    for (const std::string& clock_hz : clocks_hz()) {
      plot.values.push_back({ghz(clock_hz), over(clock_hz).value});
    }
    findings.figures.push_back(
        {pair.turned, "Median ratio over pairs of flights with the same seed.", plot});
  }
  return findings;
}

}  // namespace

Experiment clock_turned() {
  const std::vector<std::string> physics{"vehicle.physics_step_s=0.004"};
  Experiment experiment{
      "Can a mission need a clock that is turned in flight?",
      "",
      "A vehicle of 67 W of hover power flies 150 m through a forest, watches for five minutes "
      "with its rotors off, and flies home (watch_post). Two policies turn the clock; the same "
      "policies fly with each of the TX2's twelve clocks. The best fixed clock is the one that "
      "takes least among those with the most successes. Physics in steps of 4 ms.",
      {},
      {},
      evaluate};
  ExperimentSweep turned{"turned", "watch_post", physics, {}, {}};
  ExperimentSweep fixed{
      "fixed", "watch_post", physics, {{"platform.frequency_hz", clocks_hz()}}, {}};
  for (const Pair& pair : pairs) {
    turned.policies.emplace_back(pair.turned);
    fixed.policies.emplace_back(pair.fixed);
  }
  experiment.sweeps = {turned, fixed};
  return experiment;
}

}  // namespace flyball::experiments
