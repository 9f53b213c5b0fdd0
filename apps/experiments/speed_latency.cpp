// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's eq. 2: how fast a vehicle may fly that sees d metres and responds after delta;
// computed, and flown with maps that take longer and longer.

#include "flyball/runtime/guard.h"

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"

namespace flyball::experiments {
namespace {

constexpr double paper_distance_m =
    6.5;  // With a = 6 m/s^2 it gives both ends of the paper's curve.
constexpr const char* flown = "slower_maps";
constexpr double deceleration_m_s2 = 6.0;

Claim end_of_curve(double latency_s, double paper_m_s) {
  Claim claim{"eq. 2 at a response of " + std::to_string(static_cast<int>(latency_s)) + " s",
              "m/s"};
  claim.paper = PaperValue{paper_m_s, "plot of eq. 2, its ends as printed in the text"};
  claim.ours = computed(safe_speed(deceleration_m_s2, latency_s, paper_distance_m));
  return claim;
}

Figure curve() {
  LinePlot plot{"safe speed, m/s", "response, s", {}, {{"eq. 2", {}}}};
  for (int i = 0; i <= 16; ++i) {
    const double latency_s = 0.25 * i;
    plot.places.push_back(i % 4 == 0 ? std::to_string(i / 4)
                                     : std::to_string(latency_s).substr(0, 4));
    plot.lines.front().values.push_back(
        computed(safe_speed(deceleration_m_s2, latency_s, paper_distance_m)).value);
  }
  return {"eq_2", "Computed: a = 6 m/s², d = 6.5 m.", plot};
}

/// The highest speed of a flight over what eq. 2 allows for its median latency.
std::optional<double> use_of_limit(const Summary& flight) {
  return flight.max_speed_m_s /
         safe_speed(deceleration_m_s2, flight.latency_p50_s, paper_distance_m);
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  findings.claims = {end_of_curve(0.0, 8.83), end_of_curve(4.0, 1.57)};
  const SweepAxis& factors = evidence.sweep(flown).plan.axes.front();
  for (const std::string& factor : factors.values) {
    const Point point = evidence.at(flown, {factor});
    Claim claim{"flown, maps at " + factor + " times their price: highest speed over eq. 2"};
    claim.ours = median(point, use_of_limit);
    findings.claims.push_back(claim);
  }
  Claim collisions{"flown: flights that succeed, at the slowest map", "%"};
  collisions.ours = success_percent(evidence.at(flown, {factors.values.back()}));
  findings.claims.push_back(collisions);
  for (const auto& [figure, title] : {std::pair{"max_speed_m_s", "highest speed in flight, m/s"},
                                      std::pair{"latency_p50_s", "median latency in flight, s"}}) {
    PlotOf wanted{flown, title, flight_figure(figure), {"times the price of a map", {}}};
    findings.figures.push_back(
        {figure, counts_text(evidence, wanted), line_plot_of(evidence, wanted)});
  }
  findings.figures.insert(findings.figures.begin(), curve());
  return findings;
}

}  // namespace

Experiment speed_latency() {
  ExperimentSweep sweep{
      flown,
      "delivery_open",
      {"mission.max_speed_m_s=10", "mission.max_acceleration_m_s2=6", "world.goal_distance_m=100",
       "events.1.kind=slowdown", "events.1.at_s=0", "events.1.kernels=octomap"},
      {{"events.1.factor", {"0.1", "1", "3", "6", "12"}}},
      {"fixed_fine"}};
  return {
      "How fast may a vehicle fly that responds late?",
      std::string{mavbench} + ", eq. 2",
      "Eq. 2 computed for responses of 0 to 4 s, and flown over open ground with a map range of 7 "
      "m: whatever lies beyond it might be a wall, so that the vehicle may never be faster than "
      "eq. 2 allows. Maps take .1 to 12 times what the platform's file says. Over eq. 2 at the "
      "median latency a flight stays below 1, because it plans with a bound on latency and adds "
      "the interval between maps.",
      {},
      {sweep},
      evaluate};
}

}  // namespace flyball::experiments
