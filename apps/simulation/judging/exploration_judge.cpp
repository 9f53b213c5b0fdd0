// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/judging/exploration_judge.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// Cells of a box as bits; outside there is none.
class CellSet {
 public:
  CellSet(const GridCell& first, const GridCell& last) : first_{first}, last_{last} {
    std::size_t count = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      count *= static_cast<std::size_t>(last[i] - first[i] + 1);
    }
    bits_.resize(count);
  }
  void add(const GridCell& cell) {
    if (contains(cell)) {
      bits_[index(cell)] = true;
    }
  }
  [[nodiscard]] bool has(const GridCell& cell) const {
    return contains(cell) && bits_[index(cell)];
  }
  /// The cell or one that touches it.
  [[nodiscard]] bool has_near(const GridCell& cell) const {
    for (int i = 0; i < 27; ++i) {
      if (has({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1})) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool contains(const GridCell& cell) const {
    bool inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      inside = inside && cell[i] >= first_[i] && cell[i] <= last_[i];
    }
    return inside;
  }
  [[nodiscard]] std::vector<GridCell> cells() const {
    std::vector<GridCell> all;
    for (GridCell c = first_; c[2] <= last_[2]; c = next(c)) {
      if (bits_[index(c)]) {
        all.push_back(c);
      }
    }
    return all;
  }

 private:
  [[nodiscard]] GridCell next(GridCell cell) const {
    for (std::size_t i = 0; i < 2; ++i) {
      if (++cell[i] <= last_[i]) {
        return cell;
      }
      cell[i] = first_[i];
    }
    ++cell[2];
    return cell;
  }
  [[nodiscard]] std::size_t index(const GridCell& cell) const {
    const auto along = [&](std::size_t i) { return static_cast<std::size_t>(cell[i] - first_[i]); };
    const auto extent = [&](std::size_t i) {
      return static_cast<std::size_t>(last_[i] - first_[i]) + 1;
    };
    return (along(2) * extent(1) + along(1)) * extent(0) + along(0);
  }

  GridCell first_;
  GridCell last_;
  std::vector<bool> bits_{};
};

/// An occupied cell of the map, of whatever size, in the lattice's cells.
void add_cube(CellSet& set, const OccupiedCell& cube, double cell_m) {
  const Vec3 half = Vec3::Constant(0.5 * cube.size_m - 1e-6);
  const GridCell low = grid_cell_of(cube.centre_W - half, cell_m);
  const GridCell high = grid_cell_of(cube.centre_W + half, cell_m);
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int x = low[0]; x <= high[0]; ++x) {
        set.add({x, y, z});
      }
    }
  }
}

double share(const CellSet& of, const std::vector<GridCell>& cells) {
  const auto near = std::count_if(cells.begin(), cells.end(),
                                  [&](const auto& cell) { return of.has_near(cell); });
  return cells.empty() ? 0.0 : static_cast<double>(near) / static_cast<double>(cells.size());
}

}  // namespace

ExplorationJudge::ExplorationJudge(ObservableSpace space)
    : space_{std::move(space)}, unknown_{space_.cells} {}

double ExplorationJudge::coverage_percent(const OccupancyView& map) {
  const auto is_known = [&](const GridCell& cell) {
    return map.state(centre_of(cell, space_.cell_m)) != CellState::unknown;
  };
  unknown_.erase(std::remove_if(unknown_.begin(), unknown_.end(), is_known), unknown_.end());
  const auto all = static_cast<double>(space_.cells.size());
  return all > 0.0 ? 100.0 * (1.0 - static_cast<double>(unknown_.size()) / all) : 0.0;
}

MapAgreement ExplorationJudge::agreement(const Mapper& mapper) const {
  if (space_.surfaces.empty()) {
    return {};
  }
  GridCell first = space_.surfaces.front();
  GridCell last = first;
  for (const GridCell& cell : space_.surfaces) {
    for (std::size_t i = 0; i < 3; ++i) {
      first[i] = std::min(first[i], cell[i] - 1);
      last[i] = std::max(last[i], cell[i] + 1);
    }
  }
  CellSet surfaces{first, last};
  for (const GridCell& cell : space_.surfaces) {
    surfaces.add(cell);
  }
  CellSet occupied{first, last};
  for (const OccupiedCell& cube : mapper.occupied()) {
    add_cube(occupied, cube, space_.cell_m);
  }
  return {share(surfaces, occupied.cells()), share(occupied, space_.surfaces)};
}

ExplorationJudge make_exploration_judge(const Brief& brief, const World& world) {
  ObservableRequest request;
  request.body = brief.body;
  request.start_W = brief.site.start_W + Vec3::UnitZ() * brief.site.cruise_height_m;
  request.camera = brief.settings.camera;
  request.range_m = brief.settings.map.range_m;
  return ExplorationJudge{observable_space(world, request)};
}

}  // namespace flyball
