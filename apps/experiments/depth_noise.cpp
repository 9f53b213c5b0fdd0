// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's study of depth noise: Gaussian, the same at every depth, in package delivery.

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"
#include <array>

namespace flyball::experiments {
namespace {

constexpr const char* flown = "noise";
constexpr const char* in_table = "table of depth noise";

/// A row of the paper's table.
struct Row {
  const char* sigma_m;
  double failures_percent;
  double replans;
  double time_s;
};

constexpr std::array<Row, 4> table{{{"0", 0.0, 2.0, 72.0},
                                    {"0.5", 0.0, 3.0, 82.0},
                                    {"1", 0.0, 4.0, 95.0},
                                    {"1.5", 10.0, 8.0, 137.0}}};

/// One thing changed in the flights, at each row's noise.
struct Change {
  const char* sweep;
  const char* what;
  const char* scenario;
  const char* policy;
  std::vector<std::string> settings;
};

std::vector<Change> changes() {
  return {
      {"wider_cells", "with cells of .30 m", "delivery_forest", "fixed", {"map.resolution_m=0.3"}},
      {"fewer_rays",
       "with an image of 80 x 60 pixels",
       "delivery_forest",
       "fixed_fine",
       {"camera.width_px=80", "camera.height_px=60"}},
      {"open_field", "over a field without trees", "delivery_open", "fixed_fine", {}}};
}

Claim grown(const Evidence& evidence, const Row& row, const std::string& figure, double paper) {
  Claim claim{(figure == "replans" ? "replans" : "mission time") + std::string{" at "} +
              row.sigma_m + " m over 0 m"};
  claim.paper = PaperValue{paper, in_table};
  claim.neutral = 1.0;
  const auto growth = [&](const char* sweep) {
    return ratio(evidence.at(sweep, {row.sigma_m}), evidence.at(sweep, {"0"}),
                 flight_figure(figure));
  };
  claim.ours = growth(flown);
  for (const Change& change : changes()) {
    claim.causes.push_back({change.what, growth(change.sweep)});
  }
  return claim;
}

Claim success(const Evidence& evidence, const Row& row) {
  Claim claim{std::string{"flights that succeed at "} + row.sigma_m + " m", "%"};
  claim.paper = PaperValue{100.0 - row.failures_percent, in_table};
  claim.ours = success_percent(evidence.at(flown, {row.sigma_m}));
  for (const Change& change : changes()) {
    claim.causes.push_back(
        {change.what, success_percent(evidence.at(change.sweep, {row.sigma_m}))});
  }
  return claim;
}

ExperimentSweep sweep_of(const Change& change) {
  return {change.sweep,
          change.scenario,
          joined(joined(quick_map(), {"camera.rgbd_noise=false"}), change.settings),
          {{"camera.extra_noise_m", {"0", "0.5", "1", "1.5"}}},
          {change.policy}};
}

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const Row& row : table) {
    if (&row != &table.front()) {
      findings.claims.push_back(
          grown(evidence, row, "mission_time_s", row.time_s / table.front().time_s));
      findings.claims.push_back(
          grown(evidence, row, "replans", row.replans / table.front().replans));
    }
  }
  for (const Row& row : table) {
    findings.claims.push_back(success(evidence, row));
  }
  for (const auto& [figure, title] :
       {std::pair{"mission_time_s", "mission time, s"}, std::pair{"replans", "replans"}}) {
    PlotOf wanted{flown, title, flight_figure(figure), {"standard deviation of a depth, m", {}}};
    findings.figures.push_back(
        {figure, counts_text(evidence, wanted), line_plot_of(evidence, wanted)});
  }
  return findings;
}

}  // namespace

Experiment depth_noise() {
  Experiment experiment{
      "What does noise in the depth image do to a delivery?",
      std::string{mavbench} + ", study of depth noise",
      "A delivery through a forest with fixed cells of .15 m (fixed_fine), while Gaussian noise is "
      "added to every depth; the camera's own noise is off. The paper's world is another one, so "
      "times and replans are compared as ratios to those without noise. As in OctoMap, one ray "
      "that ends in a cell outweighs all of the same image that pass through it.",
      {},
      {sweep_of({flown, "", "delivery_forest", "fixed_fine", {}})},
      evaluate};
  for (const Change& change : changes()) {
    experiment.sweeps.push_back(with_few_seeds(sweep_of(change)));
  }
  return experiment;
}

}  // namespace flyball::experiments
