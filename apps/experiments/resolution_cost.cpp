// SPDX-License-Identifier: BSD-3-Clause
//
// What a map costs over the size of its cells: MAVBench's curve for OctoMap on the TX2.

#include "flyball/scenario/shipped_platform.h"
#include "flyball/studies/platform_fit.h"

#include "experiments/framework/papers.h"
#include "studies/fit_scenes.h"
#include <array>

namespace flyball::experiments {
namespace {

constexpr const char* in_plot = "octomap over the size of cells, as printed in the text";
// The scene's own cells, .15 m, and then wider ones, up to the paper's widest.
constexpr std::array<const char*, 5> wider_m{"0.20", "0.30", "0.50", "0.80", "0.98"};

double frame_ms(const PlatformModel& model, const Work& work) {
  return 1e3 *
         to_seconds(ModeledPlatform{model}.job_time("octomap", work, model.frequencies.back()));
}

/// Times of a mean frame, from .15 m on.
Result<std::vector<double>> times_ms(const PlatformModel& model) {
  std::vector<double> times;
  for (const char* cells : wider_m) {
    DeliveryScene scene = scene_a();
    scene.coarse_resolution_m = std::stod(cells);
    const auto loads = record(scene);
    if (!loads) {
      return loads.error();
    }
    if (times.empty()) {
      times.push_back(frame_ms(model, loads->kernels.at("octomap").mean()));
    }
    times.push_back(frame_ms(model, loads->coarse_map.mean()));
  }
  return times;
}

Claim limit_of(const std::string& what, double paper_ms, PaperMatch match, double ours_ms) {
  Claim claim{what, "ms"};
  claim.paper = PaperValue{paper_ms, in_plot};
  claim.match = match;
  claim.ours = computed(ours_ms);
  return claim;
}

Result<Findings> evaluate(const Evidence& /*evidence*/) {
  const auto model = find_platform("jetson_tx2");
  if (!model) {
    return model.error();
  }
  const auto fit = fit_platform("jetson_tx2");
  if (!fit) {
    return fit.error();
  }
  const auto times = times_ms(*model);
  if (!times) {
    return times.error();
  }
  Findings findings;
  Claim gain{"one frame with cells of .15 m over one with .98 m"};
  gain.paper = PaperValue{4.5, in_plot};
  gain.neutral = 1.0;
  gain.ours = computed(times->front() / times->back());
  gain.causes.push_back(
      {"with a fixed cost of 5.2 ms of the host per frame, which flights do not pay",
       computed(fit->resolution_ratio_with_fixed_cost)});
  findings.claims = {gain,
                     limit_of("one frame at .15 m", 400.0, PaperMatch::at_least, times->front()),
                     limit_of("one frame at .98 m", 100.0, PaperMatch::at_most, times->back())};
  LinePlot plot{"time of a frame on the TX2, ms", "cells, m", {"0.15"}, {{"octomap", {}}}};
  plot.places.insert(plot.places.end(), wider_m.begin(), wider_m.end());
  for (const double time : *times) {
    plot.lines.front().values.push_back(computed(time).value);
  }
  findings.figures.push_back(
      {"octomap", "Computed from the work on the mean frame of a recorded delivery (scene A).",
       plot});
  return findings;
}

}  // namespace

Experiment resolution_cost() {
  return {
      "What do smaller cells of the map cost?",
      std::string{mavbench} + ", octomap over resolution",
      "The frames of a recorded delivery go into maps of .15 to .98 m, without flights; the "
      "platform prices the work of the mean frame.",
      {"The time at .15 m, to 630 ms in package delivery; the curve is predicted. A fixed cost per "
       "frame, which is only shown beside it, was fitted to the 4.5 times."},
      {},
      evaluate};
}

}  // namespace flyball::experiments
