// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A workload: builds its graph of kernels, and decides when its mission is done.

#include "flyball/runtime/graph.h"
#include "flyball/runtime/result.h"

#include <map>
#include <memory>
#include <string>

namespace flyball {

struct FlightSettings;
struct Brief;
struct FlightParts;
struct Site;

class Workload {
 public:
  Workload() = default;
  Workload(const Workload&) = delete;
  Workload& operator=(const Workload&) = delete;
  virtual ~Workload() = default;

  /// Whether the mission can be flown with these settings in this place.
  ///
  /// @error `invalid_input`: one sentence with the key, its value and the way out.
  [[nodiscard]] virtual Status check([[maybe_unused]] const FlightSettings& settings,
                                     [[maybe_unused]] const Site& site) const {
    return Done{};
  }
  /// What this workload knows better than the settings, before the brief becomes constant: a wider
  /// tube, or that it flies without a map.
  virtual void adapt([[maybe_unused]] Brief& brief) const {}
  /// Adds its nodes to a graph that has the topics of `parts`. The workload outlives the graph's
  /// jobs.
  virtual void build(Graph& graph, const FlightParts& parts) = 0;
  /// Whether the workload needs a colour camera, a detector and trackers. If not, no colour image
  /// is rendered and no detector is needed.
  [[nodiscard]] virtual bool looks_for_people() const { return false; }
  /// Whether the world's goal is a place of this mission, once it is built.
  [[nodiscard]] virtual bool flies_to_goal() const { return false; }
  /// Figures, when the graph has stopped, that the vehicle itself believes; the unit is the name's
  /// ending. What is true, a referee says.
  [[nodiscard]] virtual std::map<std::string, double> quality() const { return {}; }
};

class Registry;
void register_workloads(Registry& registry);

}  // namespace flyball
