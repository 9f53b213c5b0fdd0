// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/scan_grid.h"

#include <algorithm>
#include <tuple>

namespace flyball {
namespace {

using Index = ScanGrid::Index;

// Cells [low, high] of a box while it grows.
struct Block {
  Index low;
  Index high;
};

// Joins blocks that follow each other along `axis` and are equal along the other two.
std::vector<Block> joined(std::vector<Block> blocks, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto side = [=](const Block& b) {
    return std::tuple{b.low[u], b.high[u], b.low[v], b.high[v]};
  };
  std::sort(blocks.begin(), blocks.end(), [&](const Block& a, const Block& b) {
    return std::tuple{side(a), a.low[axis]} < std::tuple{side(b), b.low[axis]};
  });
  std::vector<Block> out;
  for (const Block& block : blocks) {
    if (!out.empty() && side(out.back()) == side(block) &&
        out.back().high[axis] + 1 == block.low[axis]) {
      out.back().high[axis] = block.high[axis];
    } else {
      out.push_back(block);
    }
  }
  return out;
}

}  // namespace

ScanGrid::ScanGrid(double resolution_m, const Index& low, const Index& high)
    : resolution_m_{resolution_m}, low_{low}, high_{high} {
  states_.assign(offset(high) + 1, CellState::unknown);
}

Aabb ScanGrid::extent_W() const {
  return {low_.cast<double>() * resolution_m_,
          (high_ + Index::Ones()).cast<double>() * resolution_m_};
}

bool ScanGrid::contains(const Index& cell) const {
  return (cell.array() >= low_.array()).all() && (cell.array() <= high_.array()).all();
}

std::size_t ScanGrid::offset(const Index& cell) const {
  const Eigen::Matrix<std::size_t, 3, 1> at = (cell - low_).cast<std::size_t>();
  const Eigen::Matrix<std::size_t, 3, 1> n = (high_ - low_ + Index::Ones()).cast<std::size_t>();
  return (at.z() * n.y() + at.y()) * n.x() + at.x();
}

CellState ScanGrid::state(const Index& cell) const {
  return contains(cell) ? states_[offset(cell)] : CellState::unknown;
}

std::vector<Aabb> merged_boxes(const ScanGrid& grid,
                               const std::function<bool(const ScanGrid::Index&)>& is_solid) {
  // Runs along x right away: a file of a few bytes may fill 2e8 cells, too many for a list.
  std::vector<Block> runs;
  for_each_cell(grid.low(), grid.high(), [&](const Index& cell) {
    if (!is_solid(cell)) {
      return;
    }
    if (!runs.empty() && runs.back().high + Index::UnitX() == cell) {
      runs.back().high = cell;
    } else {
      runs.push_back({cell, cell});
    }
  });
  std::vector<Aabb> boxes;
  for (const Block& block : joined(joined(std::move(runs), 1), 2)) {
    boxes.push_back({block.low.cast<double>() * grid.resolution_m(),
                     (block.high + Index::Ones()).cast<double>() * grid.resolution_m()});
  }
  return boxes;
}

}  // namespace flyball
