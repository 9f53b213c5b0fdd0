// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The papers whose figures are reproduced, and what several experiments need of them.

#include "experiments/framework/experiment.h"
#include <string>
#include <vector>

namespace flyball {

constexpr const char* mavbench = "MAVBench (MICRO 2018)";
constexpr const char* roborun_paper = "RoboRun (DAC 2021, arXiv 2108.13354)";

/// The brick map, which is quick on the host, at the price of stock OctoMap, whose occupancy it
/// has.
[[nodiscard]] std::vector<std::string> quick_map();
/// The same map at its own price.
[[nodiscard]] std::vector<std::string> quick_map_at_own_price();
/// MAVBench's detector ran on the GPU and took the same time for each image.
[[nodiscard]] std::string paper_detector();

/// The five missions of MAVBench, as they are flown in this room.
struct PaperMission {
  std::string name{};  ///< As the paper has it.
  std::string scenario{};
  std::vector<std::string> settings{};
  bool takes_the_host_long{};  ///< Twenty seconds a flight, or a minute.
};
[[nodiscard]] std::vector<PaperMission> paper_missions();

/// `at_s` 0 to the end: jobs of these kernels take `factor` times what the platform's file says.
/// @param number  Of the event in its scenario, from 1 on.
[[nodiscard]] std::vector<std::string> slowed(int number,
                                              const std::string& kernels,
                                              double factor);
/// Both lists one after the other.
[[nodiscard]] std::vector<std::string> joined(std::vector<std::string> settings,
                                              const std::vector<std::string>& more);

/// For causes, and for cells that are drawn but no claim is made of.
inline constexpr std::size_t few_seeds = 3;
/// The same with at most that many.
[[nodiscard]] ExperimentSweep with_few_seeds(ExperimentSweep sweep);

/// The highest operating point, 4 cores at 2.0352 GHz, and the paper's lowest, 2 at .8064 GHz.
[[nodiscard]] std::vector<std::string> fast_corner();
[[nodiscard]] std::vector<std::string> slow_corner();

}  // namespace flyball
