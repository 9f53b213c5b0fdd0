// SPDX-License-Identifier: BSD-3-Clause
//
// MAVFI's question: what single bit flips in the messages of each stage do to a delivery, and what
// detectors of range and rate save.

#include "experiments/framework/papers.h"
#include <array>

namespace flyball::experiments {
namespace {

constexpr std::array<const char*, 6> stages{"cloud", "clearance", "plan.response",
                                            "path",  "pose",      "setpoint"};
constexpr std::array<const char*, 2> detectors{"none", "both"};
constexpr int draws = 25;

std::vector<std::string> all_draws() {
  std::vector<std::string> all;
  for (int draw = 1; draw <= draws; ++draw) {
    all.push_back(std::to_string(draw));
  }
  return all;
}

/// All flights of a stage, whichever bit was drawn.
Point flights_of(const Evidence& evidence, const char* detector, const char* stage) {
  Point all;
  all.counts_failed = true;
  for (const std::string& draw : all_draws()) {
    const Point one = evidence.at(detector, {stage, draw});
    all.flights.insert(all.flights.end(), one.flights.begin(), one.flights.end());
  }
  return all;
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  DotPlot plot{"Flights that succeed, %", {}};
  for (const char* stage : stages) {
    for (const char* detector : detectors) {
      Claim claim{
          std::string{"flights that succeed, bit flip in "} + stage + ", detectors: " + detector,
          "%"};
      claim.ours = success_percent(flights_of(evidence, detector, stage));
      plot.values.push_back({std::string{stage} + ", " + detector, claim.ours.value});
      findings.claims.push_back(claim);
    }
  }
  findings.figures.push_back({"success", "All flights of a stage: 25 draws.", plot});
  return findings;
}

}  // namespace

Experiment soft_errors() {
  Experiment experiment{
      "What does a flipped bit do to a delivery?",
      "MAVFI (arXiv 2105.12882)",
      "One bit of one number flips in a message of one stage, 12 s after the start of a delivery "
      "through a forest; number and bit are drawn evenly. With detectors, messages are refused "
      "whose numbers, or their changes, no vehicle can mean. The paper's numbers are of other "
      "worlds and another autopilot and are not repeated.",
      {},
      {},
      evaluate};
  for (const char* detector : detectors) {
    ExperimentSweep sweep{
        detector,
        "delivery_forest",
        joined(quick_map(), {"world.goal_distance_m=60", "events.1.kind=bit_flip",
                             "events.1.at_s=12", std::string{"faults.detector="} + detector}),
        {{"events.1.topic", {stages.begin(), stages.end()}}, {"events.1.draw", all_draws()}},
        {"fixed_fine"}};
    sweep.most_seeds = 1;  // The draws are many.
    experiment.sweeps.push_back(sweep);
  }
  return experiment;
}

}  // namespace flyball::experiments
