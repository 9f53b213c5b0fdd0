// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a mission can need a detector that is turned in flight: what a detector that finds as
// much for a tenth of the price would gain, which is more than turning it ever can.

#include "experiments/framework/papers.h"
#include <optional>
#include <string>

namespace flyball::experiments {
namespace {

constexpr const char* usual_price = "search";
constexpr const char* tenth_of_price = "search_at_a_tenth";
constexpr const char* five_prices = "search_at_five_times";
constexpr const char* photography = "photography";

Claim search_claim(const Evidence& evidence, const char* price, const std::string& words) {
  Claim claim{"search: energy with a detector at " + words + " its price over that at its price"};
  claim.ours =
      ratio(evidence.at(price, {}), evidence.at(usual_price, {}), flight_figure("energy_total_kj"));
  claim.neutral = 1.0;
  return claim;
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  findings.claims = {search_claim(evidence, tenth_of_price, "a tenth of"),
                     search_claim(evidence, five_prices, "five times"),
                     success_claim("search", evidence.at(usual_price, {}))};
  Claim share{"photography: the whole computer's share of the energy", "%"};
  share.ours = median(evidence.at(photography, {}), [](const Summary& flight) {
    return std::optional{100.0 * flight.energy_computer_j /
                         (flight.energy_computer_j + flight.energy_rotor_j)};
  });
  findings.claims.push_back(share);
  findings.claims.push_back(success_claim("photography", evidence.at(photography, {})));
  return findings;
}

ExperimentSweep search_sweep(const char* price, double factor) {
  return {price, "search_collapsed_building", slowed(1, "hog", factor), {}, {"mission_energy"}};
}

}  // namespace

Experiment detector_turned() {
  return {
      "Can a mission need a detector that is turned in flight?",
      "",
      "A kind or scale of the detector that is turned in flight can at best find as much as the "
      "best fixed one, and cost less. So somebody is searched for with the detector's jobs at "
      "their price, at a tenth of it, which is more than turning can gain, and at five times, as "
      "on a computer that is so much slower at them. A photography lasts as long whatever its "
      "detector costs, so there turning can gain no more than what the computer takes.",
      {},
      {search_sweep(usual_price, 1.0),
       search_sweep(tenth_of_price, 0.1),
       search_sweep(five_prices, 5.0),
       {photography, "photography_park", {"detector.scale=2"}, {}, {"fixed_fine"}}},
      evaluate};
}

}  // namespace flyball::experiments
