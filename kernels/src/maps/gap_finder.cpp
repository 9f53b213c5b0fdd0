// SPDX-License-Identifier: BSD-3-Clause
#include "maps/gap_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace flyball {
namespace {

constexpr double pi = 3.141592653589793;
constexpr std::int64_t max_columns = 16'000'000;
constexpr int directions = 16;        // Over a half turn: a bridge looks the same from both ends.
constexpr double group_size_m = 0.6;  // About a door: its gaps form one or two groups.

/// Occupied columns of a region, on the lattice of the map's cells (multiples of the resolution).
class ColumnGrid {
 public:
  struct Column {
    int x{};
    int y{};
  };

  ColumnGrid(MotionChecker& checker, const Aabb& region_W)
      : checker_{checker}, region_{region_W}, size_m_{checker.resolution_m()} {
    first_x_ = std::floor(region_W.min.x() / size_m_);
    first_y_ = std::floor(region_W.min.y() / size_m_);
    const double across_x = std::ceil(region_W.max.x() / size_m_) - first_x_;
    const double across_y = std::ceil(region_W.max.y() / size_m_) - first_y_;
    if (!(across_x >= 1.0 && across_y >= 1.0) ||
        across_x * across_y > static_cast<double>(max_columns)) {
      return;
    }
    columns_x_ = static_cast<int>(across_x);
    columns_y_ = static_cast<int>(across_y);
    bits_.assign(static_cast<std::size_t>(columns_x_) * static_cast<std::size_t>(columns_y_), 0);
    int span = 1;
    while (span < std::max(columns_x_, columns_y_)) {
      span *= 2;
    }
    mark(0, 0, span);
  }

  [[nodiscard]] const std::vector<Column>& occupied() const { return occupied_; }
  [[nodiscard]] double size_m() const { return size_m_; }
  [[nodiscard]] bool is_occupied(const Vec3& p_W) const {
    const double x = std::floor(p_W.x() / size_m_) - first_x_;
    const double y = std::floor(p_W.y() / size_m_) - first_y_;
    return x >= 0.0 && y >= 0.0 && x < columns_x_ && y < columns_y_ &&
           bits_[index(static_cast<int>(x), static_cast<int>(y))] != 0;
  }
  [[nodiscard]] Vec3 centre(const Column& column) const {
    return {(first_x_ + column.x + 0.5) * size_m_, (first_y_ + column.y + 0.5) * size_m_,
            0.5 * (region_.min.z() + region_.max.z())};
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_x_) +
           static_cast<std::size_t>(x);
  }

  /// Quadtree: large empty squares cost one query.
  void mark(int x, int y, int span) {
    if (x >= columns_x_ || y >= columns_y_ || !checker_.has_occupied(square(x, y, span))) {
      return;
    }
    if (span == 1) {
      bits_[index(x, y)] = 1;
      occupied_.push_back({x, y});
      return;
    }
    const int half = span / 2;
    mark(x, y, half);
    mark(x + half, y, half);
    mark(x, y + half, half);
    mark(x + half, y + half, half);
  }

  [[nodiscard]] Aabb square(int x, int y, int span) const {
    const double inset_m = 0.01 * size_m_;  // Not to touch the neighbours by rounding.
    return {
        {(first_x_ + x) * size_m_ + inset_m, (first_y_ + y) * size_m_ + inset_m, region_.min.z()},
        {(first_x_ + x + span) * size_m_ - inset_m, (first_y_ + y + span) * size_m_ - inset_m,
         region_.max.z()}};
  }

  MotionChecker& checker_;
  Aabb region_;
  double size_m_;
  double first_x_{};
  double first_y_{};
  int columns_x_{};
  int columns_y_{};
  std::vector<std::uint8_t> bits_;
  std::vector<Column> occupied_;
};

struct WidthRange {
  double min_m{};
  double max_m{};
};

std::array<Vec3, directions> half_turn() {
  std::array<Vec3, directions> all;
  for (int i = 0; i < directions; ++i) {
    const double angle_rad = pi * i / directions;
    all[static_cast<std::size_t>(i)] = {std::cos(angle_rad), std::sin(angle_rad), 0.0};
  }
  all[directions / 2] = Vec3::UnitY();  // cos(pi / 2) is not zero; walls along y are common.
  return all;
}

/// Where the ray from `from` changes between free at `free_m` and occupied at `occupied_m`.
double border_m(
    const ColumnGrid& grid, const Vec3& from, const Vec3& along, double free_m, double occupied_m) {
  constexpr int halvings = 20;  // A quarter of a cell becomes less than a micrometre.
  for (int i = 0; i < halvings; ++i) {
    const double middle_m = 0.5 * (free_m + occupied_m);
    (grid.is_occupied(from + middle_m * along) ? occupied_m : free_m) = middle_m;
  }
  return 0.5 * (free_m + occupied_m);
}

/// From an occupied column along `gap.across_W` to the next one; false when it is too near or far.
bool bridge(const ColumnGrid& grid, const Vec3& from, const WidthRange& width, Gap& gap) {
  const double step_m = 0.25 * grid.size_m();
  const Vec3 along = gap.across_W;
  int leaves = 0;
  for (int i = 1; i * step_m < width.max_m + 2.0 * grid.size_m(); ++i) {
    const bool occupied = grid.is_occupied(from + i * step_m * along);
    if (leaves == 0 && occupied && i > 3) {
      return false;  // Inside a wall: another column starts this bridge.
    }
    if (leaves == 0 && !occupied) {
      leaves = i;
    } else if (leaves > 0 && occupied) {
      const double left_m = border_m(grid, from, along, leaves * step_m, (leaves - 1) * step_m);
      const double right_m = border_m(grid, from, along, (i - 1) * step_m, i * step_m);
      gap.width_m = right_m - left_m;
      gap.centre_W = from + 0.5 * (left_m + right_m) * along;
      return gap.width_m >= width.min_m && gap.width_m <= width.max_m;
    }
  }
  return false;
}

/// By place, so that the order does not depend on how the gaps were found.
using GapMap = std::map<std::pair<double, double>, GapGroup>;

void add_gaps_from(const ColumnGrid& grid,
                   const Vec3& from,
                   const WidthRange& width,
                   GapMap& gaps) {
  static const auto across = half_turn();
  for (const Vec3& direction : across) {
    Gap gap;
    gap.across_W = direction;
    if (bridge(grid, from, width, gap)) {
      const Eigen::Vector2d place = gap.centre_W.head<2>() / group_size_m;
      gaps[{std::floor(place.x()), std::floor(place.y())}].push_back(gap);
    }
  }
}

}  // namespace

std::vector<GapGroup> find_gaps(MotionChecker& checker, const Aabb& region_W) {
  const ColumnGrid grid{checker, region_W};
  const double diameter_m = 2.0 * checker.body().radius_m;
  GapMap gaps;
  for (const auto& column : grid.occupied()) {
    add_gaps_from(grid, grid.centre(column), {diameter_m, 2.0 * diameter_m}, gaps);
  }
  std::vector<GapGroup> groups;
  for (auto& [place, group] : gaps) {
    std::stable_sort(group.begin(), group.end(),
                     [](const Gap& a, const Gap& b) { return a.width_m < b.width_m; });
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace flyball
