// SPDX-License-Identifier: BSD-3-Clause
//
// RoboRun's comparison of its governor with a static worst-case setting, on its own published
// latencies.

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"

namespace flyball::experiments {
namespace {

constexpr const char* flown = "policies";

Claim compared(const Evidence& evidence,
               const std::string& what,
               const std::string& figure,
               double paper) {
  const FlightFigure of = flight_figure(figure);
  const bool is_speed = figure == "mean_speed_m_s";
  const auto against = [&](const std::string& policy) {
    const Point other = evidence.at(flown, {}, policy);
    const Point own = evidence.at(flown, {}, "roborun_own");
    return is_speed ? ratio(own, other, of) : ratio(other, own, of);
  };
  Claim claim{what};
  claim.paper = PaperValue{paper, "abstract"};
  claim.neutral = 1.0;
  claim.ours = against("fixed_roborun");
  claim.causes.push_back(
      {"against a static setting that is tuned for these worlds", against("fixed_tuned")});
  return claim;
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  findings.claims = {compared(evidence, "mission time, static over RoboRun", "mission_time_s", 4.5),
                     compared(evidence, "energy, static over RoboRun", "energy_total_kj", 4.0),
                     compared(evidence, "mean speed, RoboRun over static", "mean_speed_m_s", 5.0)};
  findings.figures = {policies_plot(evidence, flown, "mission_time_s", "mission time, s"),
                      policies_plot(evidence, flown, "energy_total_kj", "energy, kJ"),
                      policies_plot(evidence, flown, "mean_speed_m_s", "mean speed, m/s")};
  findings.notes.emplace_back(
      "The paper's published logs show less than its abstract: one static flight of 1536 s and 703 "
      "kJ "
      "against 435 to 680 s and 248 to 390 kJ of four others, 2.85 times the time and 2.34 times "
      "the "
      "energy.");
  return findings;
}

}  // namespace

Experiment roborun() {
  return {
      "What does RoboRun's governor gain over its static setting?",
      roborun_paper,
      "A delivery between two crowds of blocks on platform roborun, which charges the paper's own "
      "latencies. The goal is 400 m away, not 600 to 1200 m: the static setting would empty the "
      "battery on its way. One camera instead of six, cells up to 1.2 m instead of 9.6 m.",
      {"Latency model and prices to the paper's six insertion times and fixed stages."},
      {{flown,
        "delivery_congestion",
        {"platform.name=roborun", "world.goal_m=400", "vehicle.physics_step_s=0.004"},
        {},
        {"fixed_roborun", "roborun_own", "fixed_tuned", "mission_energy"}}},
      evaluate};
}

}  // namespace flyball::experiments
