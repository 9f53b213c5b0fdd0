// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A mission context around a dense map that tests fill by hand.

#include "flyball/flight/mission_context.h"
#include "flyball/scenario/knobs.h"
#include "flyball/scenario/plugins.h"

#include "grid_map.h"
#include <memory>

namespace flyball::kit {

/// Shows a dense map as a mapper's view; inserts nothing.
class GridMapper final : public Mapper {
 public:
  explicit GridMapper(const GridMap& map) : map_{map} {}
  Result<Work> prepare(const PointCloud&, const Pose&, const MapperSettings&) override {
    return Work{};
  }
  void commit() override {}
  void declare_clear(const Vec3& centre_W, const Cylinder&) override {
    declared_W.push_back(centre_W);
  }
  [[nodiscard]] const OccupancyView& view() const override { return map_; }
  [[nodiscard]] std::shared_ptr<const OccupancyView> revision() override {
    return std::make_shared<const GridMap>(map_);
  }
  [[nodiscard]] std::vector<OccupiedCell> occupied() const override { return {}; }

  std::vector<Vec3> declared_W{};

 private:
  const GridMap& map_;
};

/// One core at 1 GHz that knows no kernel: every job is free.
inline PlatformModel free_of_charge() {
  PlatformModel model;
  model.name = "free_of_charge";
  model.frequencies = {Hertz{1e9}};
  return model;
}

struct MissionRig {
  explicit MissionRig(const GridMap& map, Scenario chosen = one_core(), MissionBrief brief = {})
      : scenario{std::move(chosen)} {
    MissionEquipment equipment;
    equipment.body = {0.325, 0.1};
    equipment.knobs = KnobSettings{standard_knobs(scenario, platform).value()};
    auto grid_mapper = std::make_unique<GridMapper>(map);
    mapper = grid_mapper.get();
    equipment.kernels.mapper = std::move(grid_mapper);
    equipment.kernels.path_tracker = all_plugins().make<PathTracker>("feedforward_pd");
    context = std::make_unique<MissionContext>(flight_settings(scenario), platform, trace,
                                               std::move(brief), std::move(equipment));
  }

  static Scenario one_core() {
    Scenario scenario;
    scenario.platform.cores = 1;
    scenario.platform.frequency_hz = 1e9;
    return scenario;
  }

  Scenario scenario;
  ModeledPlatform platform{free_of_charge()};
  MemoryRecorder trace;
  GridMapper* mapper{};  ///< The context's.
  std::unique_ptr<MissionContext> context;
};

/// A straight corridor along x, 40 m of it known free, then unknown.
inline GridMap corridor(double known_to_m) {
  GridMap map{{Vec3{-2.0, -3.0, 0.0}, Vec3{60.0, 3.0, 3.0}}, 0.15, CellState::unknown};
  map.fill({Vec3{-2.0, -3.0, 0.0}, Vec3{known_to_m, 3.0, 3.0}}, CellState::free);
  return map;
}

}  // namespace flyball::kit
