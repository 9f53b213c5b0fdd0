// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/known_share.h"

#include "flyball/runtime/assert.h"

#include <cmath>

namespace flyball {
namespace {

std::size_t cells_along(double extent_m, double cell_m) {
  return static_cast<std::size_t>(std::max(0.0, std::ceil(extent_m / cell_m - 1e-9)));
}

}  // namespace

KnownShare::KnownShare(const Aabb& volume_W, double cell_m)
    : min_W_{volume_W.min},
      cell_m_{cell_m},
      columns_{cells_along(volume_W.max.x() - volume_W.min.x(), cell_m)},
      rows_{cells_along(volume_W.max.y() - volume_W.min.y(), cell_m)},
      layers_{cells_along(volume_W.max.z() - volume_W.min.z(), cell_m)} {
  FLYBALL_ASSERT(cell_m > 0.0, "cells of %g m", cell_m);
  marks_.resize(columns_ * rows_ * layers_);
}

Vec3 KnownShare::centre_W(std::size_t cell) const {
  const std::size_t layer = cell / (columns_ * rows_);
  const std::size_t row = cell / columns_ % rows_;
  const std::size_t column = cell % columns_;
  return min_W_ + cell_m_ * Vec3{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5,
                                 static_cast<double>(layer) + 0.5};
}

/// Marks the unknown ones of the six neighbours.
void KnownShare::spread_from(std::size_t cell) {
  const auto reach = [this](std::size_t neighbour) {
    if (marks_[neighbour] == Mark::unknown) {
      marks_[neighbour] = Mark::reachable;
      front_.push_back(neighbour);
    }
  };
  const std::size_t column = cell % columns_;
  const std::size_t row = cell / columns_ % rows_;
  const std::size_t layer = cell / (columns_ * rows_);
  const std::size_t plane = columns_ * rows_;
  if (column > 0) {
    reach(cell - 1);
  }
  if (column + 1 < columns_) {
    reach(cell + 1);
  }
  if (row > 0) {
    reach(cell - columns_);
  }
  if (row + 1 < rows_) {
    reach(cell + columns_);
  }
  if (layer > 0) {
    reach(cell - plane);
  }
  if (layer + 1 < layers_) {
    reach(cell + plane);
  }
}

double KnownShare::percent(const OccupancyView& map) {
  std::size_t known = 0;
  front_.clear();
  for (std::size_t cell = 0; cell < marks_.size(); ++cell) {
    const CellState state = map.state(centre_W(cell));
    marks_[cell] = state == CellState::unknown ? Mark::unknown
                   : state == CellState::free  ? Mark::known_free
                                               : Mark::known_solid;
    known += state == CellState::unknown ? 0U : 1U;
    if (state == CellState::free) {
      front_.push_back(cell);
    }
  }
  known_m3_ = static_cast<double>(known) * cell_m_ * cell_m_ * cell_m_;
  const std::size_t free_cells = front_.size();
  std::size_t looked_at = 0;
  while (looked_at < front_.size()) {  // Free cells first, then what they reach, in that order.
    spread_from(front_[looked_at++]);
  }
  const std::size_t reachable = front_.size() - free_cells;
  const auto all = static_cast<double>(known + reachable);
  // Where nothing is known to be free, as behind a first look at a floor, nothing can be said of
  // what can be reached.
  return free_cells == 0 ? 0.0 : 100.0 * static_cast<double>(known) / all;
}

double known_area_m2(const OccupancyView& map, const Aabb& volume_W, double z_m, double square_m) {
  FLYBALL_ASSERT(square_m > 0.0, "squares of %g m", square_m);
  const std::size_t columns = cells_along(volume_W.max.x() - volume_W.min.x(), square_m);
  const std::size_t rows = cells_along(volume_W.max.y() - volume_W.min.y(), square_m);
  std::size_t known = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Vec3 p_W{volume_W.min.x() + square_m * (static_cast<double>(column) + 0.5),
                     volume_W.min.y() + square_m * (static_cast<double>(row) + 0.5), z_m};
      known += map.state(p_W) == CellState::unknown ? 0U : 1U;
    }
  }
  return static_cast<double>(known) * square_m * square_m;
}

}  // namespace flyball
