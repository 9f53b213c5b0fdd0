// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is known on board, around a dense map that tests fill by hand.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/navigation/situation.h"
#include "flyball/scenario/knobs.h"

#include "grid_map.h"
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace flyball::kit {

/// Shows a dense map as a mapper's view, and these cells as what is occupied; inserts nothing.
class GridMapper : public Mapper {
 public:
  explicit GridMapper(const GridMap& map, std::vector<OccupiedCell> cells = {})
      : map_{map}, cells_{std::move(cells)} {}
  Result<Work> prepare(const PointCloud&, const Pose&, const MapperSettings&) override {
    return Work{};
  }
  void commit() override {}
  void declare_clear(const Vec3&, const Cylinder&) override {}
  [[nodiscard]] const OccupancyView& view() const override { return map_; }
  [[nodiscard]] std::shared_ptr<const OccupancyView> revision() override {
    return std::make_shared<const GridMap>(map_);
  }
  [[nodiscard]] std::vector<OccupiedCell> occupied() const override { return cells_; }

 private:
  const GridMap& map_;
  std::vector<OccupiedCell> cells_;
};

/// One core at 1 GHz that knows no kernel: every job is free.
inline PlatformModel free_of_charge() {
  PlatformModel model;
  model.name = "free_of_charge";
  model.frequencies = {Hertz{1e9}};
  return model;
}

struct MissionRig {
  explicit MissionRig(const GridMap& map, Scenario chosen = one_core(), Site site = {})
      : scenario{std::move(chosen)}, view{map} {
    brief->settings = flight_settings(scenario);
    brief->site = std::move(site);
    brief->platform = platform;
    brief->body = {0.325, 0.1};
    set(KnobSettings{standard_knobs(scenario, *platform).value()});
    kernels.mapper = std::make_shared<GridMapper>(map);
    kernels.path_tracker = scenario.plugins.make<PathTracker>("feedforward_pd");
  }

  static Scenario one_core() {
    Scenario scenario;
    scenario.platform.cores = 1;
    scenario.platform.frequency_hz = 1e9;
    return scenario;
  }

  /// A new snapshot of the knobs.
  void set(const KnobSettings& settings) {
    knobs = std::make_shared<const KnobsInForce>(knobs_at_start(settings));
  }
  /// The same with one knob turned. @return Whether it could be.
  bool set(const std::string& knob, double value) {
    KnobsInForce next = *knobs;
    const bool is_set = next.knobs.set(knob, value).ok();
    knobs = std::make_shared<const KnobsInForce>(std::move(next));
    return is_set;
  }
  [[nodiscard]] Situation situation() const { return {*brief, *knobs, view}; }
  [[nodiscard]] FlightParts parts(Graph& graph, const VehicleExtras& extras = {}) const {
    return {brief, add_vehicle_topics(graph, extras), add_mission_topics(graph), kernels};
  }

  Scenario scenario;
  const GridMap& view;
  std::shared_ptr<const ModeledPlatform> platform{
      std::make_shared<const ModeledPlatform>(free_of_charge())};
  std::shared_ptr<Brief> brief{std::make_shared<Brief>()};
  std::shared_ptr<const KnobsInForce> knobs{};
  MissionKernels kernels{};
};

/// A straight corridor along x, 40 m of it known free, then unknown.
inline GridMap corridor(double known_to_m, double cell_m = 0.15) {
  GridMap map{{Vec3{-2.0, -3.0, 0.0}, Vec3{60.0, 3.0, 3.0}}, cell_m, CellState::unknown};
  map.fill({Vec3{-2.0, -3.0, 0.0}, Vec3{known_to_m, 3.0, 3.0}}, CellState::free);
  return map;
}

}  // namespace flyball::kit
