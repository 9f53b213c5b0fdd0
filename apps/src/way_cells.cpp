// SPDX-License-Identifier: BSD-3-Clause
#include "way_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace flyball {
namespace {

constexpr double cell_m = 0.25;
// A way over eight neighbours is at most 1 / cos(22.5 degrees) times as long as the straight one.
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

struct Reached {
  double cost{};
  double length_m{};
  int cell{};
  friend bool operator>(const Reached& a, const Reached& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.cell > b.cell;
  }
};

int count(double from_m, double to_m) {
  return std::max(1, static_cast<int>(std::ceil((to_m - from_m) / cell_m)));
}

}  // namespace

WayCells::WayCells(const World& world, const Cylinder& body)
    : bounds_W_{world.bounds_W},
      // Of all places in the cell one may fit: what the smaller body in the middle touches, the
      // whole one touches wherever it is.
      body_{std::max(0.0, body.radius_m - 0.5 * diagonal_m),
            std::max(0.0, body.half_height_m - 0.5 * cell_m)},
      columns_{count(bounds_W_.min.x(), bounds_W_.max.x())},
      rows_{count(bounds_W_.min.y(), bounds_W_.max.y())},
      open_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  const Clearance truth{world};
  for (std::size_t cell = 0; cell < open_.size(); ++cell) {
    open_[cell] = is_open(truth, centre_W(static_cast<int>(cell))) ? 1 : 0;
  }
}

bool WayCells::is_open(const Clearance& truth, const Vec3& centre) const {
  constexpr double enough_m = 0.01;
  for (double z = bounds_W_.min.z(); z < bounds_W_.max.z() + 0.5 * cell_m; z += cell_m) {
    if (truth.distance_m({centre.x(), centre.y(), z}, body_, enough_m, true) > 0.0) {
      return true;
    }
  }
  return false;
}

Vec3 WayCells::centre_W(int cell) const {
  return {bounds_W_.min.x() + (cell % columns_ + 0.5) * cell_m,
          bounds_W_.min.y() + (cell / columns_ + 0.5) * cell_m,
          0.5 * (bounds_W_.min.z() + bounds_W_.max.z())};
}

int WayCells::cell_at(const Vec3& p_W) const {
  const auto index = [](double from_m, double at_m, int n) {
    return std::clamp(static_cast<int>(std::floor((at_m - from_m) / cell_m)), 0, n - 1);
  };
  return index(bounds_W_.min.y(), p_W.y(), rows_) * columns_ +
         index(bounds_W_.min.x(), p_W.x(), columns_);
}

std::vector<double> WayCells::costs(const std::function<double(const Vec3&)>& cost_per_m) const {
  std::vector<double> all(open_.size(), infinite);
  for (std::size_t cell = 0; cell < open_.size(); ++cell) {
    if (open_[cell] != 0) {
      all[cell] = cost_per_m(centre_W(static_cast<int>(cell)));
    }
  }
  return all;
}

std::optional<CheapestWay> WayCells::way(
    const Vec3& from_W,
    const Vec3& to_W,
    const std::function<double(const Vec3&)>& cost_per_m) const {
  const std::vector<double> price = costs(cost_per_m);
  std::vector<double> least(open_.size(), infinite);
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  const int goal = cell_at(to_W);
  queue.push({0.0, 0.0, cell_at(from_W)});
  least[static_cast<std::size_t>(cell_at(from_W))] = 0.0;
  while (!queue.empty()) {
    const Reached here = queue.top();
    queue.pop();
    if (here.cell == goal) {
      return CheapestWay{here.cost / longest_detour, here.length_m / longest_detour};
    }
    if (here.cost > least[static_cast<std::size_t>(here.cell)]) {
      continue;
    }
    for (const Step& step : steps) {
      const int column = here.cell % columns_ + step.column;
      const int row = here.cell / columns_ + step.row;
      if (column < 0 || column >= columns_ || row < 0 || row >= rows_) {
        continue;
      }
      const auto next = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column);
      const auto from = static_cast<std::size_t>(here.cell);
      // The cheaper one of both cells: the border between two prices lies somewhere between.
      const double cost = here.cost + step.length_m * std::min(price[next], price[from]);
      if (price[next] < infinite && cost < least[next]) {
        least[next] = cost;
        queue.push({cost, here.length_m + step.length_m, static_cast<int>(next)});
      }
    }
  }
  return std::nullopt;
}

}  // namespace flyball
