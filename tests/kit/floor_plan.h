// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A world cut at flight height into full cells: where can a disc go on a map of that resolution?

#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flyball {

class FloorPlan {
 public:
  /// Cell (i, j) is [i r, (i + 1) r) x ...; it is blocked when a solid between the two heights
  /// overlaps its inside, however little.
  FloorPlan(const World& world, double resolution_m, double from_z_m, double to_z_m)
      : resolution_m_{resolution_m} {
    x0_ = index(world.bounds_W.min.x());
    y0_ = index(world.bounds_W.min.y());
    nx_ = index(world.bounds_W.max.x()) - x0_ + 1;
    ny_ = index(world.bounds_W.max.y()) - y0_ + 1;
    blocked_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_), 0);
    for (const Aabb& box : world.boxes) {
      if (box.max.z() > from_z_m && box.min.z() < to_z_m) {
        block(box);
      }
    }
  }

  /// Whether a disc can move between two places along the cells' centres, four ways, touching no
  /// blocked cell. @pre The radius is positive. Exact for such paths: between neighbours the disc
  /// sweeps no other cells than at the two ends.
  [[nodiscard]] bool connects(const Vec3& from, const Vec3& to, double disc_radius_m) const {
    const std::vector<char> free = passable(disc_radius_m);
    const std::size_t goal = cell(to);
    std::vector<char> seen(free.size(), 0);
    std::vector<std::size_t> open;
    const auto visit = [&](std::size_t at) {
      if (free[at] != 0 && seen[at] == 0) {
        seen[at] = 1;
        open.push_back(at);
      }
    };
    visit(cell(from));
    while (!open.empty() && seen[goal] == 0) {
      const std::size_t at = open.back();
      open.pop_back();
      visit(at - 1);  // The rim is never free, so neighbours are inside.
      visit(at + 1);
      visit(at - static_cast<std::size_t>(nx_));
      visit(at + static_cast<std::size_t>(nx_));
    }
    return seen[goal] != 0;
  }

 private:
  [[nodiscard]] int index(double x_m) const {
    return static_cast<int>(std::floor(x_m / resolution_m_));
  }

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }

  [[nodiscard]] std::size_t cell(const Vec3& p) const {
    return at(index(p.x()) - x0_, index(p.y()) - y0_);
  }

  void block(const Aabb& box) {
    constexpr double touch_m = 1e-9;
    const int x1 = std::min(index(box.max.x() - touch_m) - x0_, nx_ - 1);
    const int y1 = std::min(index(box.max.y() - touch_m) - y0_, ny_ - 1);
    for (int y = std::max(index(box.min.y() + touch_m) - y0_, 0); y <= y1; ++y) {
      for (int x = std::max(index(box.min.x() + touch_m) - x0_, 0); x <= x1; ++x) {
        blocked_[at(x, y)] = 1;
      }
    }
  }

  // Cells where a disc at the centre touches no blocked one. The rim is never free.
  [[nodiscard]] std::vector<char> passable(double disc_radius_m) const {
    const int reach = static_cast<int>(std::ceil(disc_radius_m / resolution_m_ + 0.5));
    std::vector<char> free(blocked_.size(), 0);
    for (int y = reach; y < ny_ - reach; ++y) {
      std::fill_n(free.begin() + static_cast<std::ptrdiff_t>(at(reach, y)), nx_ - 2 * reach, 1);
    }
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        if (blocked_[at(x, y)] != 0) {
          close_around(free, x, y, disc_radius_m);
        }
      }
    }
    return free;
  }

  void close_around(std::vector<char>& free, int x, int y, double disc_radius_m) const {
    const int reach = static_cast<int>(std::ceil(disc_radius_m / resolution_m_ + 0.5));
    const auto gap = [this](int cells) {
      return std::max((std::abs(cells) - 0.5) * resolution_m_, 0.0);
    };
    for (int j = std::max(y - reach, 0); j <= std::min(y + reach, ny_ - 1); ++j) {
      for (int i = std::max(x - reach, 0); i <= std::min(x + reach, nx_ - 1); ++i) {
        if (std::hypot(gap(i - x), gap(j - y)) < disc_radius_m) {
          free[at(i, j)] = 0;
        }
      }
    }
  }

  double resolution_m_;
  int x0_{};
  int y0_{};
  int nx_{};
  int ny_{};
  std::vector<char> blocked_;
};

}  // namespace flyball
