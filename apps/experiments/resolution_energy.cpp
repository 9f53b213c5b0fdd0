// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's case study of a map whose cells change in flight: fine, coarse, or both.

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"

namespace flyball::experiments {
namespace {

constexpr const char* flown = "policies";
constexpr const char* in_text = "case study of dynamic resolution";

Claim saved_by(const Evidence& evidence, const std::string& policy, const std::string& what) {
  Claim claim{what};
  claim.ours = ratio(evidence.at(flown, {}, "fixed_fine"), evidence.at(flown, {}, policy),
                     flight_figure("battery_used_percent"));
  claim.neutral = 1.0;
  return claim;
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  Claim dynamic = saved_by(evidence, "two_level", "battery: .15 m everywhere over .15 and .80 m");
  dynamic.paper = PaperValue{1.8, std::string{in_text} + ": up to 1.8 times"};
  dynamic.causes.push_back(
      {"the same in the open alone, where cells are coarse (delivery_forest)",
       ratio(evidence.at("open", {}, "fixed_fine"), evidence.at("open", {}, "fixed_coarse"),
             flight_figure("battery_used_percent"))});
  findings.claims.push_back(dynamic);
  Claim coarse{".80 m everywhere: flights that succeed", "%"};
  coarse.paper = PaperValue{0.0, std::string{in_text} + ": fails"};
  coarse.ours = success_percent(evidence.at(flown, {}, "fixed_coarse"));
  findings.claims.push_back(coarse);
  findings.claims.push_back(
      saved_by(evidence, "mission_energy", "battery: .15 m everywhere over mission_energy"));
  findings.figures = {policies_plot(evidence, flown, "battery_used_percent", "battery used, %"),
                      policies_plot(evidence, flown, "mission_time_s", "mission time, s"),
                      policies_plot(evidence, flown, "mean_speed_m_s", "mean speed, m/s")};
  return findings;
}

}  // namespace

Experiment resolution_energy() {
  return {
      "What is it worth to change the map's cells in flight?",
      std::string{mavbench} + ", case study of dynamic resolution",
      "A delivery over 300 m of field into a building, flown with cells of .15 m (fixed_fine), of "
      ".80 m (fixed_coarse), with the paper's switch between both (two_level), and with "
      "mission_energy. Ratios pair the seeds where both succeed.",
      {"The world's doors stand on the grid so that .15 m passes them and .80 m does not, which "
       "the paper reports; kindness has doors anywhere."},
      {{flown,
        "delivery_outdoor_to_indoor",
        {},
        {},
        {"fixed_fine", "fixed_coarse", "two_level", "mission_energy"}},
       {"open", "delivery_forest", {}, {}, {"fixed_fine", "fixed_coarse"}}},
      evaluate};
}

}  // namespace flyball::experiments
