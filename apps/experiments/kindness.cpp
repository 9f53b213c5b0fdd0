// SPDX-License-Identifier: BSD-3-Clause
//
// Where the simulated world is kind to a map: doors that stand on its grid, and depth without
// noise.

#include "experiments/framework/papers.h"

namespace flyball::experiments {
namespace {

constexpr const char* flown = "world";

Result<Findings> evaluate(const Evidence& evidence) {
  Findings findings;
  for (const std::string& policy : evidence.sweep(flown).plan.policies) {
    DotPlot plot{policy + ": battery used, %", {}};
    for (const char* doors : {"fine", "random"}) {
      for (const char* noise : {"false", "true"}) {
        const Point point = evidence.at(flown, {doors, noise}, policy);
        const std::string name =
            std::string{doors == std::string{"fine"} ? "doors on the grid" : "doors anywhere"} +
            (noise == std::string{"true"} ? ", noise" : ", no noise");
        plot.values.push_back({name, median(point, flight_figure("battery_used_percent")).value});
        findings.claims.push_back(success_claim(policy + ", " + name, point));
      }
    }
    findings.figures.push_back(
        {policy, "Median over the flights that succeed; - where none does.", plot});
  }
  findings.notes.emplace_back(
      "An occupied cell blocks with its full cube, so a door of .82 m is open to a body of .65 m "
      "on "
      "cells of .15 m only where it stands well on their grid.");
  return findings;
}

}  // namespace

Experiment kindness() {
  return {
      "How kind is the world to the map?",
      "",
      "The delivery into a building with doors on the map's grid or anywhere, and with the noise "
      "of "
      "an RGB-D camera or without. MAVBench does not say how its doors stood.",
      {},
      {{flown,
        "delivery_outdoor_to_indoor",
        quick_map(),
        {{"world.door_alignment", {"fine", "random"}}, {"camera.rgbd_noise", {"false", "true"}}},
        {"fixed_fine", "two_level_lattice", "mission_energy"}}},
      evaluate};
}

}  // namespace flyball::experiments
