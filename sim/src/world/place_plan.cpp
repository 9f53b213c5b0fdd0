// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/place_plan.h"

#include "flyball/runtime/text/number_text.h"

#include "sensors/scan_grid.h"
#include "world/scan_file.h"
#include "world/solid_surface.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace flyball {
namespace {

// As in scanned_place.cpp: the heights between which a vehicle flies there.
constexpr double below_m = 0.3;
constexpr double above_m = 0.5;

bool is_map(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) {
    return false;
  }
  std::ifstream file{path, std::ios::binary};
  std::string line;
  return std::getline(file, line) && line.rfind("# Octomap", 0) == 0;
}

Result<ScanGrid> read_place(const std::string& path, const PlaceView& view) {
  return is_map(path) ? read_scan(path)
                      : read_mesh(path, {view.cell_m, view.metres_per_unit, up_axis(view.up)});
}

/// Later: occupied beats free, free beats unknown.
CellState stronger(CellState a, CellState b) {
  const auto rank = [](CellState state) {
    return state == CellState::occupied ? 2 : state == CellState::free ? 1 : 0;
  };
  return rank(a) < rank(b) ? b : a;
}

}  // namespace

Result<PlacePlan> plan_of_place(const std::string& file, const PlaceView& view) {
  const std::string path = scan_path(file);
  const auto grid = read_place(path, view);
  if (!grid) {
    return grid.error();
  }
  const double cell_m = grid->resolution_m();
  const double middle_m = view.ground_z_m + view.height_m;
  ScanGrid::Index low = grid->low();
  ScanGrid::Index high = grid->high();
  const Aabb extent_W = grid->extent_W();
  if (extent_W.min.z() >= middle_m + above_m || extent_W.max.z() <= middle_m - below_m) {
    return Error{ErrorCode::invalid_input,
                 "\"" + file + "\" reaches from z = " + short_number_text(extent_W.min.z()) +
                     " to " + short_number_text(extent_W.max.z()) +
                     " m and has nothing at the height of the plan; set --ground and --height"};
  }
  low.z() = std::max(low.z(), static_cast<int>(std::floor((middle_m - below_m) / cell_m + 1e-6)));
  high.z() =
      std::min(high.z(), static_cast<int>(std::ceil((middle_m + above_m) / cell_m - 1e-6)) - 1);
  PlacePlan plan{extent_W, cell_m, high.x() - low.x() + 1, high.y() - low.y() + 1, {}};
  plan.cells.assign(static_cast<std::size_t>(plan.columns) * static_cast<std::size_t>(plan.rows),
                    is_map(path) ? CellState::unknown : CellState::free);  // A mesh hides nothing.
  for_each_cell(low, high, [&](const ScanGrid::Index& cell) {
    const auto row = static_cast<std::size_t>(cell.y() - low.y());
    CellState& seen = plan.cells[row * static_cast<std::size_t>(plan.columns) +
                                 static_cast<std::size_t>(cell.x() - low.x())];
    seen = stronger(seen, grid->state(cell));
  });
  return plan;
}

}  // namespace flyball
