// SPDX-License-Identifier: BSD-3-Clause
//
// MAVBench's table of kernel times at the highest operating point, beside what the same kernels
// take in flight here, and beside their static prices on the recorded scenes of the fit.

#include "flyball/studies/platform_fit.h"

#include "experiments/framework/papers.h"

namespace flyball::experiments {
namespace {

/// A cell of the paper's table.
struct Cell {
  std::string mission{};
  std::string kernel{};  ///< On the price list.
  std::string name{};    ///< In the paper.
  double ms{};
};

std::vector<Cell> table() {
  return {{"delivery", "octomap", "octomap", 630.0},
          {"delivery", "rrt_connect", "path planning", 182.0},
          {"delivery", "visual_slam", "SLAM", 55.0},
          {"delivery", "depth_to_points", "point cloud", 2.0},
          {"delivery", "swept_cylinder", "collision check", 1.0},
          {"delivery", "track", "path tracking", 1.0},
          {"mapping", "octomap", "octomap", 482.0},
          {"mapping", "nbvp", "frontier exploration", 2647.0},
          {"mapping", "visual_slam", "SLAM", 46.0},
          {"mapping", "depth_to_points", "point cloud", 2.0},
          {"mapping", "swept_cylinder", "collision check", 1.0},
          {"search", "octomap", "octomap", 427.0},
          {"search", "nbvp", "frontier exploration", 2693.0},
          {"search", "yolov2", "detection", 271.0},
          {"search", "visual_slam", "SLAM", 45.0},
          {"search", "depth_to_points", "point cloud", 2.0},
          {"search", "swept_cylinder", "collision check", 1.0},
          {"photography", "yolov2", "detection", 307.0},
          {"photography", "kcf_buffered", "tracking, buffered", 80.0},
          {"photography", "kcf_real_time", "tracking, real-time", 18.0},
          {"scanning", "lawnmower", "lawn-mower planning", 89.0},
          {"scanning", "track", "path tracking", 1.0}};
}

/// The scene on which the price of a kernel was recorded or predicted, as `flyball fit` names it.
std::string scene_of(const std::string& mission) {
  return mission == "search" ? "ruin (search)" : "rooms (mapping)";
}

std::optional<double> static_ms(const PlatformFit& fit, const Cell& cell) {
  const bool is_predicted = cell.mission == "mapping" || cell.mission == "search";
  for (const KernelPrediction& each : fit.predictions) {
    if (is_predicted && each.kernel == cell.kernel && each.scene == scene_of(cell.mission)) {
      return each.model_ms;
    }
  }
  for (const KernelFit& each : fit.kernels) {
    const bool is_fitted_here = each.paper_ms == cell.ms;
    if (is_fitted_here && each.kernel == cell.kernel) {
      return each.model_ms;
    }
  }
  return std::nullopt;
}

/// The world in which octomap and planner were fitted, flown instead of recorded.
constexpr const char* fitted_world = "fitted_world";

Claim claim_of(const Evidence& evidence, const PlatformFit& fit, const Cell& cell) {
  const std::string figure = "kernel." + cell.kernel + ".mean_ms";
  Point flown = evidence.at(cell.mission, {});
  flown.counts_failed = true;
  Claim claim{cell.mission + ": " + cell.name, "ms"};
  claim.paper = PaperValue{cell.ms, "table of kernel times"};
  claim.ours = median(flown, flight_figure(figure));
  if (const auto price_ms = static_ms(fit, cell)) {
    claim.causes.push_back({"the same prices on the fit's recorded scene", computed(*price_ms)});
  }
  if (cell.mission == "delivery") {
    claim.causes.push_back({"flown in the world of the fit, delivery_outdoor_to_indoor",
                            median(evidence.at(fitted_world, {}), flight_figure(figure))});
  }
  return claim;
}

Figure comparison(const std::vector<Claim>& claims) {
  DotPlot plot{"time in flight over the paper's time", {}};
  for (const Claim& claim : claims) {
    const auto& ours = claim.ours.value;
    const double paper = claim.paper->value;
    plot.values.push_back(
        {claim.what, ours ? std::optional{MedianInterval{ours->median / paper, ours->lo / paper,
                                                         ours->hi / paper}}
                          : std::nullopt});
  }
  return {"in_flight_over_paper",
          "Mean of each flight, then the median over flights; 1 is the paper's time.", plot};
}

Result<Findings> evaluate(const Evidence& evidence) {
  const auto fit = fit_platform("jetson_tx2");
  if (!fit) {
    return fit.error();
  }
  Findings findings;
  for (const Cell& cell : table()) {
    findings.claims.push_back(claim_of(evidence, *fit, cell));
  }
  findings.figures.push_back(comparison(findings.claims));
  return findings;
}

}  // namespace

Experiment kernel_breakdown() {
  Experiment experiment{
      "What do the kernels take in flight?",
      std::string{mavbench} + ", table of kernel times on the TX2",
      "The five missions at 4 cores and 2.0352 GHz with a fine map (fixed_fine); a job's time runs "
      "from its start to its end, so that it contains contention, but no queue. Flights that fail "
      "count, too.",
      {"Octomap, planner, SLAM, point cloud and collision check to delivery, the next view to "
       "mapping, detection to the mean of both its times, trackers and lawn-mower to their own: "
       "each "
       "by one scale, on recorded scenes. In flight they meet other scenes."},
      {},
      evaluate};
  for (const PaperMission& mission : paper_missions()) {
    experiment.sweeps.push_back({mission.name,
                                 mission.scenario,
                                 joined(mission.settings, fast_corner()),
                                 {},
                                 {"fixed_fine"}});
  }
  experiment.sweeps.push_back(with_few_seeds({fitted_world,
                                              "delivery_outdoor_to_indoor",
                                              joined(quick_map(), fast_corner()),
                                              {},
                                              {"fixed_fine"}}));
  return experiment;
}

}  // namespace flyball::experiments
