// SPDX-License-Identifier: BSD-3-Clause
#include "studies/path_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace flyball {
namespace {

constexpr double cell_m = 0.25;
// A path over eight neighbours is at most 1 / cos(22.5 degrees) times as long as the straight one.
constexpr double longest_detour = 1.0823922002923940;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Step {
  int column{};
  int row{};
  double length_m{};
};
const double diagonal_m = std::sqrt(2.0) * cell_m;
const std::array<Step, 8> steps{{{1, 0, cell_m},
                                 {-1, 0, cell_m},
                                 {0, 1, cell_m},
                                 {0, -1, cell_m},
                                 {1, 1, diagonal_m},
                                 {1, -1, diagonal_m},
                                 {-1, 1, diagonal_m},
                                 {-1, -1, diagonal_m}}};

/// A cell in the queue, with what the path over it costs at least from start to goal.
struct Waiting {
  double at_least{};
  int cell{};
  friend bool operator>(const Waiting& a, const Waiting& b) {
    return a.at_least != b.at_least ? a.at_least > b.at_least : a.cell > b.cell;
  }
};

int count(double from_m, double to_m) {
  return std::max(1, static_cast<int>(std::ceil((to_m - from_m) / cell_m)));
}

}  // namespace

/// Hart, Nilsson and Raphael 1968 (A*), doi:10.1109/TSSC.1968.300136: no path is cheaper than the
/// straight one over eight neighbours at the least price, so what is found first is the cheapest.
class PathSearch {
 public:
  PathSearch(const PathCells& cells, const PathPrice& price, int goal)
      : cells_{cells},
        price_{price},
        goal_{goal},
        cost_(cells.open_.size(), infinite),
        length_m_(cells.open_.size(), 0.0) {}

  std::optional<CheapestPath> from(int start) {
    reach(start, 0.0, 0.0);
    while (!queue_.empty()) {
      const Waiting next = queue_.top();
      queue_.pop();
      if (next.cell == goal_) {
        return CheapestPath{cost_[index(goal_)] / longest_detour,
                            length_m_[index(goal_)] / longest_detour};
      }
      if (next.at_least <= cost_[index(next.cell)] + to_goal(next.cell)) {  // Else it is outdated.
        expand(next.cell);
      }
    }
    return std::nullopt;
  }

 private:
  static std::size_t index(int cell) { return static_cast<std::size_t>(cell); }

  void reach(int cell, double cost, double length_m) {
    if (cost < cost_[index(cell)]) {
      cost_[index(cell)] = cost;
      length_m_[index(cell)] = length_m;
      queue_.push({cost + to_goal(cell), cell});
    }
  }

  void expand(int cell) {
    const double price_here = price_.in_cell(cells_.extent_W(cell));
    for (const Step& step : steps) {
      const int column = cell % cells_.columns_ + step.column;
      const int row = cell / cells_.columns_ + step.row;
      if (column < 0 || column >= cells_.columns_ || row < 0 || row >= cells_.rows_) {
        continue;
      }
      const int next = row * cells_.columns_ + column;
      if (!cells_.is_open(next)) {
        continue;
      }
      // The lower price of both cells counts, because the border between them lies anywhere between
      // the centres.
      const double per_m = std::min(price_here, price_.in_cell(cells_.extent_W(next)));
      reach(next, cost_[index(cell)] + step.length_m * per_m,
            length_m_[index(cell)] + step.length_m);
    }
  }

  [[nodiscard]] double to_goal(int cell) const {
    const int across = std::abs(cell % cells_.columns_ - goal_ % cells_.columns_);
    const int along = std::abs(cell / cells_.columns_ - goal_ / cells_.columns_);
    const int diagonal = std::min(across, along);
    return price_.least * (diagonal * diagonal_m + (across + along - 2 * diagonal) * cell_m);
  }

  const PathCells& cells_;
  const PathPrice& price_;
  int goal_;
  std::vector<double> cost_;
  std::vector<double> length_m_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue_{};
};

PathCells::PathCells(const World& world, const Cylinder& body)
    : truth_{world},
      bounds_W_{world.bounds_W},
      // The body may fit at some place of the cell although it does not in the middle. So a smaller
      // body is tested in the middle: what that touches, the whole body touches anywhere in the
      // cell.
      body_{std::max(0.0, body.radius_m - 0.5 * diagonal_m),
            std::max(0.0, body.half_height_m - 0.5 * cell_m)},
      columns_{count(bounds_W_.min.x(), bounds_W_.max.x())},
      rows_{count(bounds_W_.min.y(), bounds_W_.max.y())},
      open_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

bool PathCells::is_open(int cell) const {
  Openness& known = open_[static_cast<std::size_t>(cell)];
  if (known == Openness::not_asked) {
    const Aabb extent = extent_W(cell);
    known = fits_at(0.5 * (extent.min + extent.max)) ? Openness::open : Openness::shut;
  }
  return known == Openness::open;
}

bool PathCells::fits_at(const Vec3& centre_W) const {
  constexpr double enough_m = 0.01;
  for (double z = bounds_W_.min.z(); z < bounds_W_.max.z() + 0.5 * cell_m; z += cell_m) {
    if (truth_.distance_m({centre_W.x(), centre_W.y(), z}, body_, enough_m, true) > 0.0) {
      return true;
    }
  }
  return false;
}

Aabb PathCells::extent_W(int cell) const {
  const int column = cell % columns_;
  const int row = cell / columns_;
  const Vec3 low{bounds_W_.min.x() + column * cell_m, bounds_W_.min.y() + row * cell_m,
                 bounds_W_.min.z()};
  return {low, {low.x() + cell_m, low.y() + cell_m, bounds_W_.max.z()}};
}

int PathCells::cell_at(const Vec3& p_W) const {
  const auto index = [](double from_m, double at_m, int n) {
    return std::clamp(static_cast<int>(std::floor((at_m - from_m) / cell_m)), 0, n - 1);
  };
  return index(bounds_W_.min.y(), p_W.y(), rows_) * columns_ +
         index(bounds_W_.min.x(), p_W.x(), columns_);
}

std::optional<CheapestPath> PathCells::path(const Vec3& from_W,
                                            const Vec3& to_W,
                                            const PathPrice& price) const {
  return PathSearch{*this, price, cell_at(to_W)}.from(cell_at(from_W));
}

}  // namespace flyball
