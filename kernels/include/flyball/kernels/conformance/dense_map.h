// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A dense map for tests: cells are set one by one, queries are answered by looking at every cell
/// in reach, so it is slow, simple and independent of any real map.

#include "flyball/runtime/occupancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace flyball {

/// Outside its bounds everything is unknown.
class DenseMap final : public OccupancyView {
 public:
  DenseMap(const Aabb& bounds_W, double resolution_m, CellState everywhere = CellState::free)
      : resolution_m_{resolution_m} {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<int>(i);
      first_[i] = cell(bounds_W.min[axis] + 1e-9);
      count_[i] = cell(bounds_W.max[axis] - 1e-9) - first_[i] + 1;
    }
    cells_.assign(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                      static_cast<std::size_t>(count_[2]),
                  everywhere);
  }

  /// Interfaces do not copy; a scene that is returned by value does.
  DenseMap(const DenseMap& other)
      : OccupancyView{},
        resolution_m_{other.resolution_m_},
        first_{other.first_},
        count_{other.count_},
        cells_{other.cells_} {}
  DenseMap& operator=(const DenseMap&) = delete;
  ~DenseMap() override = default;

  /// Sets every cell whose centre lies in the box.
  void fill(const Aabb& box_W, CellState state) {
    for_cells(box_W, [&](std::size_t index, const Aabb& cube) {
      if (box_W.contains(0.5 * (cube.min + cube.max))) {
        cells_[index] = state;
      }
      return false;
    });
  }

  [[nodiscard]] double resolution_m() const override { return resolution_m_; }
  [[nodiscard]] CellState state(const Vec3& p_W) const override {
    return state_at(cell(p_W.x()), cell(p_W.y()), cell(p_W.z()));
  }
  [[nodiscard]] CellState body_state(const Vec3& p_WB, const Cylinder& body) const override {
    const Vec3 half{body.radius_m, body.radius_m, body.half_height_m};
    CellState worst = CellState::free;
    if (!inside(cell(p_WB.x() - half.x()), 0) || !inside(cell(p_WB.x() + half.x()), 0) ||
        !inside(cell(p_WB.y() - half.y()), 1) || !inside(cell(p_WB.y() + half.y()), 1) ||
        !inside(cell(p_WB.z() - half.z()), 2) || !inside(cell(p_WB.z() + half.z()), 2)) {
      worst = CellState::unknown;
    }
    for_cells({p_WB - half, p_WB + half}, [&](std::size_t index, const Aabb& cube) {
      if (cells_[index] > worst && hits(p_WB, p_WB, body, cube)) {  // Most cells are free.
        worst = cells_[index];
      }
      return worst == CellState::occupied;
    });
    return worst;
  }
  [[nodiscard]] bool has_occupied(const Aabb& box) const override {
    return any_occupied(box, [&](const Aabb& cube) {
      return (cube.min.array() < box.max.array()).all() &&
             (cube.max.array() > box.min.array()).all();
    });
  }
  /// Looks at one slab of the segment after the other: a box around a long diagonal is mostly air.
  [[nodiscard]] bool segment_hits(const Vec3& from,
                                  const Vec3& to,
                                  const Cylinder& body) const override {
    const Vec3 half{body.radius_m, body.radius_m, body.half_height_m};
    const int slabs = std::max(1, static_cast<int>(std::ceil((to - from).norm())));
    for (int i = 0; i < slabs; ++i) {
      const Vec3 a = from + (to - from) * (static_cast<double>(i) / slabs);
      const Vec3 b = from + (to - from) * ((i + 1.0) / slabs);
      if (any_occupied({a.cwiseMin(b) - half, a.cwiseMax(b) + half},
                       [&](const Aabb& cube) { return hits(from, to, body, cube); })) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] double obstacle_density(const Vec3& p_W,
                                        double radius_m,
                                        double half_band_m) const override {
    constexpr double column_m = 0.8;
    int columns = 0;
    int occupied = 0;
    for (double x = -radius_m; x <= radius_m; x += column_m) {
      for (double y = -radius_m; y <= radius_m; y += column_m) {
        if (std::hypot(x, y) <= radius_m) {
          const Vec3 half{0.5 * column_m, 0.5 * column_m, half_band_m};
          const Vec3 centre = p_W + Vec3{x, y, 0.0};
          ++columns;
          occupied += has_occupied({centre - half, centre + half}) ? 1 : 0;
        }
      }
    }
    return static_cast<double>(occupied) / std::max(columns, 1);
  }
  [[nodiscard]] double nearest_obstacle_m(const Vec3& p_W,
                                          double limit_m,
                                          double half_band_m) const override {
    double nearest = limit_m;
    const Vec3 reach{limit_m, limit_m, half_band_m};
    for_cells({p_W - reach, p_W + reach}, [&](std::size_t index, const Aabb& cube) {
      if (cells_[index] == CellState::occupied) {
        const Vec3 gap = (cube.min - p_W).cwiseMax(p_W - cube.max).cwiseMax(0.0);
        nearest = std::min(nearest, gap.head<2>().norm());
      }
      return false;
    });
    return nearest;
  }

 private:
  [[nodiscard]] int cell(double x) const { return static_cast<int>(std::floor(x / resolution_m_)); }
  [[nodiscard]] bool inside(int i, std::size_t axis) const {
    return i >= first_[axis] && i < first_[axis] + count_[axis];
  }
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z - first_[2]) * static_cast<std::size_t>(count_[1]) +
            static_cast<std::size_t>(y - first_[1])) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(x - first_[0]);
  }
  [[nodiscard]] CellState state_at(int x, int y, int z) const {
    return inside(x, 0) && inside(y, 1) && inside(z, 2) ? cells_[index(x, y, z)]
                                                        : CellState::unknown;
  }
  /// Visits the stored cells that the box touches, until the visitor returns true.
  template <class Visit>
  void for_cells(const Aabb& box, Visit visit) const {
    int low[3];
    int high[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<int>(i);
      low[i] = std::max(cell(box.min[axis]), first_[i]);
      high[i] = std::min(cell(box.max[axis]), first_[i] + count_[i] - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          const Vec3 corner = Vec3{double(x), double(y), double(z)} * resolution_m_;
          if (visit(index(x, y, z), Aabb{corner, corner + Vec3::Constant(resolution_m_)})) {
            return;
          }
        }
      }
    }
  }
  template <class Test>
  [[nodiscard]] bool any_occupied(const Aabb& box, Test test) const {
    bool found = false;
    for_cells(box, [&](std::size_t index, const Aabb& cube) {
      found = cells_[index] == CellState::occupied && test(cube);
      return found;
    });
    return found;
  }

  /// Does the cylinder overlap the cube while its centre moves from `a` to `b`?
  static bool hits(const Vec3& a, const Vec3& b, const Cylinder& body, const Aabb& cube) {
    double from = 0.0;  // The part of the motion in which heights overlap.
    double to = 1.0;
    const double low = cube.min.z() - body.half_height_m - a.z();
    const double high = cube.max.z() + body.half_height_m - a.z();
    const double rise = b.z() - a.z();
    if (rise == 0.0) {
      if (low >= 0.0 || high <= 0.0) {
        return false;
      }
    } else {
      from = std::max(from, std::min(low / rise, high / rise));
      to = std::min(to, std::max(low / rise, high / rise));
      if (from >= to) {
        return false;
      }
    }
    using Vec2 = Eigen::Vector2d;
    const Vec2 p = (a + from * (b - a)).head<2>();
    const Vec2 q = (a + to * (b - a)).head<2>();
    return distance(p, q, cube.min.head<2>(), cube.max.head<2>()) < body.radius_m;
  }
  /// Between the segment pq and a rectangle.
  static double distance(const Eigen::Vector2d& p,
                         const Eigen::Vector2d& q,
                         const Eigen::Vector2d& min,
                         const Eigen::Vector2d& max) {
    const auto of_point = [&](const Eigen::Vector2d& x) {
      return (min - x).cwiseMax(x - max).cwiseMax(0.0).norm();
    };
    const Eigen::Vector2d d = q - p;
    if (d.isZero(0.0)) {
      return of_point(p);
    }
    double from = 0.0;
    double to = 1.0;
    bool crosses = true;
    for (int i = 0; i < 2; ++i) {
      if (d[i] == 0.0) {
        crosses = crosses && p[i] >= min[i] && p[i] <= max[i];
        continue;
      }
      const double one = (min[i] - p[i]) / d[i];
      const double other = (max[i] - p[i]) / d[i];
      from = std::max(from, std::min(one, other));
      to = std::min(to, std::max(one, other));
    }
    if (crosses && from <= to) {
      return 0.0;
    }
    const auto of_corner = [&](double x, double y) {
      const Eigen::Vector2d corner{x, y};
      const double u =
          std::clamp((corner - p).dot(d) / std::max(d.squaredNorm(), 1e-300), 0.0, 1.0);
      return (p + u * d - corner).norm();
    };
    return std::min({of_point(p), of_point(q), of_corner(min.x(), min.y()),
                     of_corner(min.x(), max.y()), of_corner(max.x(), min.y()),
                     of_corner(max.x(), max.y())});
  }

  double resolution_m_;
  std::array<int, 3> first_{};
  std::array<int, 3> count_{};
  std::vector<CellState> cells_;
};

}  // namespace flyball
