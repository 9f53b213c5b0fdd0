// SPDX-License-Identifier: BSD-3-Clause
// tested-in: all_experiments

#include "experiments/framework/papers.h"

#include "studies/plots/csv.h"

namespace flyball {

std::vector<std::string> quick_map() {
  return {"kernels.mapper=flyball", "kernels.mapper_parameters.cost_of=octomap"};
}

std::vector<std::string> quick_map_at_own_price() {
  return {"kernels.mapper=flyball", "kernels.mapper_parameters.cost_of=flyball"};
}

std::string paper_detector() {
  return "detector.cost_of=yolov2";
}

std::vector<PaperMission> paper_missions() {
  return {{"scanning", "scanning_farm", {}},
          {"delivery", "delivery_forest", quick_map()},
          {"mapping", "mapping_office", {}, true},
          {"search", "search_collapsed_building", {paper_detector()}, true},
          {"photography", "photography_park", {paper_detector()}, true}};
}

std::vector<std::string> slowed(int number, const std::string& kernels, double factor) {
  const std::string event = "events." + std::to_string(number) + ".";
  return {event + "kind=slowdown", event + "at_s=0", event + "factor=" + csv_number(factor),
          event + "kernels=" + kernels};
}

std::vector<std::string> joined(std::vector<std::string> settings,
                                const std::vector<std::string>& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

ExperimentSweep with_few_seeds(ExperimentSweep sweep) {
  sweep.most_seeds = few_seeds;
  return sweep;
}

std::vector<std::string> fast_corner() {
  return {"platform.cores=4", "platform.frequency_hz=2.0352e9"};
}

std::vector<std::string> slow_corner() {
  return {"platform.cores=2", "platform.frequency_hz=0.8064e9"};
}

}  // namespace flyball
