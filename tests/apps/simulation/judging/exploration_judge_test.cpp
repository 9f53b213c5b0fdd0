// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/judging/exploration_judge.h"

#include "grid_map.h"
#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double cell_m = 0.15;

/// Free space over a floor of 20 x 20 cells.
ObservableSpace floor_space() {
  ObservableSpace space;
  space.cell_m = cell_m;
  for (int z = 0; z < 5; ++z) {
    for (int i = 0; i < 400; ++i) {
      const GridCell cell{i % 20, i / 20, z};
      space.cells.push_back(cell);
      if (z == 0) {
        space.surfaces.push_back(cell);
      }
    }
  }
  return space;
}

TEST(ExplorationJudge, counts_what_the_map_knows_of_what_can_be_seen) {
  kit::GridMap map{{{0, 0, 0}, {3, 3, 0.75}}, cell_m, CellState::unknown};
  ExplorationJudge judge{floor_space()};
  EXPECT_EQ(judge.coverage_percent(map), 0.0);
  map.fill({{0, 0, 0}, {3, 1.5, 0.75}}, CellState::free);
  EXPECT_NEAR(judge.coverage_percent(map), 50.0, 1e-9);
  map.fill({{0, 1.5, 0}, {3, 3, 0.15}}, CellState::occupied);
  EXPECT_NEAR(judge.coverage_percent(map), 60.0, 1e-9);
}

TEST(ExplorationJudge, holds_occupied_cells_against_the_surfaces_with_one_cell_of_tolerance) {
  const kit::GridMap map{{{0, 0, 0}, {3, 3, 0.75}}, cell_m};
  const ExplorationJudge judge{floor_space()};
  std::vector<OccupiedCell> cells;
  for (int i = 0; i < 200; ++i) {  // Half of the floor, one cell too high.
    cells.push_back({centre_of({i % 20, i / 20, 1}, cell_m), cell_m});
  }
  const MapAgreement half = judge.agreement(kit::GridMapper{map, cells});
  EXPECT_EQ(half.precision, 1.0);
  EXPECT_NEAR(half.recall, 220.0 / 400.0, 1e-9);
}

TEST(ExplorationJudge, finds_what_floats_in_the_air_wrong) {
  const kit::GridMap map{{{0, 0, 0}, {3, 3, 0.75}}, cell_m};
  ObservableSpace space = floor_space();
  space.surfaces.push_back({0, 0, 4});  // So that the box is as high.
  const ExplorationJudge judge{space};
  const std::vector<OccupiedCell> cells{{centre_of({5, 5, 0}, cell_m), cell_m},
                                        {centre_of({9, 9, 3}, cell_m), cell_m}};
  EXPECT_NEAR(judge.agreement(kit::GridMapper{map, cells}).precision, 0.5, 1e-9);
}

TEST(ExplorationJudge, takes_a_coarse_cell_as_the_fine_ones_in_it) {
  const kit::GridMap map{{{0, 0, 0}, {3, 3, 0.75}}, cell_m};
  const ExplorationJudge judge{floor_space()};
  const MapAgreement coarse = judge.agreement(kit::GridMapper{map, {{{0.3, 0.3, 0.3}, 0.6}}});
  EXPECT_GT(coarse.recall, 16.0 / 400.0 - 1e-9);
}

}  // namespace
}  // namespace flyball
