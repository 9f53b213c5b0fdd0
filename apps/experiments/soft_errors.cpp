// SPDX-License-Identifier: BSD-3-Clause
//
// MAVFI's question: what single bit flips in the messages of each stage do to a delivery, and what
// detectors of range and rate save.

#include "experiments/framework/papers.h"
#include <algorithm>
#include <array>

namespace flyball::experiments {
namespace {

constexpr std::array<const char*, 6> stages{"cloud", "clearance", "plan.response",
                                            "path",  "pose",      "setpoint"};
constexpr std::array<const char*, 2> detectors{"none", "both"};
constexpr int draws = 84;            // With all stages and detectors a thousand flights.
constexpr double lengthened = 1.02;  // Over the flight without a fault: no rounding comes so far.

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

/// Of the flights that succeed.
Measured longest(const Point& point, double faultless_s) {
  double most_s = 0.0;
  for (const Summary* flight : point.flights) {
    most_s = has_succeeded(*flight) ? std::max(most_s, flight->mission_time_s) : most_s;
  }
  return most_s > 0.0 ? computed(most_s / faultless_s) : Measured{};
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  DotPlot success{"Flights that succeed, %", {}};
  DotPlot late{"Flights that take 2 % longer than without a fault, %", {}};
  for (const char* stage : stages) {
    for (const char* detector : detectors) {
      const std::string fault = std::string{"bit flip in "} + stage + ", detectors: " + detector;
      const Point flown = flights_of(evidence, detector, stage);
      const Measured faultless = median(evidence.at(std::string{"no_fault_"} + detector, {}),
                                        flight_figure("mission_time_s"));
      if (!faultless.value) {
        return Error{ErrorCode::failed,
                     "the flight without a fault, detectors: " + std::string{detector} +
                         ", did not succeed: nothing can be compared with it"};
      }
      const double faultless_s = faultless.value->median;
      const auto is_late = [faultless_s](const Summary& flight) {
        return has_succeeded(flight) && flight.mission_time_s > lengthened * faultless_s;
      };
      const Claim succeed = success_claim(fault, flown);
      Claim lengthen{fault + ": flights that take 2 % longer than without", "%"};
      lengthen.ours = share_percent(flown, is_late);
      Claim most{fault + ": longest time of a flight over that without"};
      most.ours = longest(flown, faultless_s);
      success.values.push_back({std::string{stage} + ", " + detector, succeed.ours.value});
      late.values.push_back({std::string{stage} + ", " + detector, lengthen.ours.value});
      findings.claims.insert(findings.claims.end(), {succeed, lengthen, most});
    }
  }
  const std::string caption =
      "All flights of a stage: " + std::to_string(draws) + " draws of a number and a bit.";
  findings.figures.push_back({"success", caption, success});
  findings.figures.push_back({"late", caption, late});
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
    const std::vector<std::string> faultless = joined(
        quick_map(), {"world.goal_distance_m=60", std::string{"faults.detector="} + detector});
    ExperimentSweep sweep{
        detector,
        "delivery_forest",
        joined(faultless, {"events.1.kind=bit_flip", "events.1.at_s=12"}),
        {{"events.1.topic", {stages.begin(), stages.end()}}, {"events.1.draw", all_draws()}},
        {"fixed_fine"}};
    sweep.most_seeds = 1;  // The draws are many.
    ExperimentSweep beside{
        std::string{"no_fault_"} + detector, "delivery_forest", faultless, {}, {"fixed_fine"}};
    beside.most_seeds = 1;
    experiment.sweeps.insert(experiment.sweeps.end(), {sweep, beside});
  }
  return experiment;
}

}  // namespace flyball::experiments
