// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a mission can need cores that are switched off and on in flight: what all idle cores take
// at the best fixed number of them, which is more than turning it ever can gain.

#include "flyball/scenario/shipped_platform.h"

#include "experiments/framework/papers.h"
#include <optional>
#include <string>
#include <vector>

namespace flyball::experiments {
namespace {

constexpr const char* policy = "mission_energy";
constexpr double worth_turning = 0.03;  // Of the energy; a knob that gains less is left alone.

struct Watch {
  const char* scenario;
  std::string words;  ///< Of the claims.
  bool flies{};
};

std::vector<Watch> watches() {
  return {{"watch_post", "flies there, watches and flies home", true},
          {"watch_perched", "only watches", false}};
}

std::vector<std::string> numbers_of_cores() {
  return {"1", "2", "3", "4"};
}

/// Energy over that with the best number of cores.
void compare_numbers(const Evidence& evidence,
                     const Watch& watch,
                     const std::string& best,
                     Findings& findings) {
  const Point least = evidence.at(watch.scenario, {best});
  for (const std::string& cores : numbers_of_cores()) {
    if (cores != best) {
      Claim claim{watch.words + ": energy with " + cores + " of 4 cores over that with " + best};
      claim.ours =
          ratio(evidence.at(watch.scenario, {cores}), least, flight_figure("energy_total_kj"));
      findings.claims.push_back(claim);
    }
  }
  findings.claims.push_back(success_claim(watch.words + ", with " + best, least));
}

/// More cores make no flight worse. So turning them takes no less than all of them do, but for what
/// all but one take while they idle, here from the first moment to the last.
void bound_gain(const Evidence& evidence,
                const Watch& watch,
                const PowerCost& power,
                Findings& findings) {
  const std::string all = numbers_of_cores().back();
  const Point flights = evidence.at(watch.scenario, {all});
  const double can_be_off = std::stod(all) - 1.0;
  Claim most{watch.words + ": what turning them gains at most, of the energy with " + all, "%"};
  most.ours = median(flights, [&](const Summary& flight) {
    const double idle_w = can_be_off * power.off_core_power().value();
    return std::optional{100.0 * idle_w * flight.mission_time_s / flight.energy_total_j()};
  });
  Claim needed{watch.words + ": power of an idle core at which that is 3 %", "W"};
  needed.ours = median(flights, [&](const Summary& flight) {
    const double most_w = worth_turning * flight.energy_total_j() / flight.mission_time_s;
    return std::optional{most_w / (can_be_off * power.converter)};
  });
  needed.causes.push_back({"a TX2's", computed(power.idle_core_w)});
  findings.claims.push_back(most);
  findings.claims.push_back(needed);
}

Result<Findings> evaluate(const Evidence& evidence) {
  const auto model = find_platform("jetson_tx2");
  if (!model) {
    return model.error();
  }
  Findings findings;
  for (const Watch& watch : watches()) {
    const std::string best = best_in_hindsight(evidence, watch.scenario, numbers_of_cores());
    compare_numbers(evidence, watch, best, findings);
    if (watch.flies) {  // Else the work is the same from beginning to end.
      bound_gain(evidence, watch, model->power, findings);
    }
  }
  return findings;
}

}  // namespace

Experiment cores_turned() {
  Experiment experiment{
      "Can a mission need cores that are switched in flight?",
      "",
      "A core that is off saves what it takes while it idles; one that is missing makes maps and "
      "plans late. So a vehicle of 67 W of hover power flies 150 m through a forest, watches for "
      "five minutes with its rotors off, and flies home (watch_post), and another one only "
      "watches (watch_perched), with one to four cores from beginning to end. What all but one "
      "core would take if they idled all the time is more than turning their number can gain over "
      "the best fixed one. Physics in steps of 4 ms.",
      {},
      {},
      evaluate};
  for (const Watch& watch : watches()) {
    experiment.sweeps.push_back({watch.scenario,
                                 watch.scenario,
                                 {"vehicle.physics_step_s=0.004"},
                                 {{"platform.cores", numbers_of_cores()}},
                                 {policy}});
  }
  return experiment;
}

}  // namespace flyball::experiments
