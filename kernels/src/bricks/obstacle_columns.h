// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Obstacle density: the share of the columns around a place that hold an obstacle.

#include "flyball/runtime/geometry.h"

#include <cmath>

namespace flyball {

/// Columns of fixed size, on a lattice through the world's origin, in a disc and an altitude band.
class ObstacleColumns {
 public:
  static constexpr double column_m = 0.8;  ///< Fixed by the definition of density.

  ObstacleColumns(const Vec3& p_W, double radius_m, double half_band_m)
      : p_W_{p_W}, radius_m_{radius_m}, half_band_m_{half_band_m} {
    all_ = {first(p_W.x()), first(p_W.y()), 1};
    while (static_cast<double>(all_.count) * column_m < 2.0 * radius_m + 2.0 * column_m) {
      all_.count *= 2;
    }
  }

  /// @param is_occupied  Whether a box meets an obstacle.
  template <class IsOccupied>
  [[nodiscard]] double density(IsOccupied&& is_occupied) const {
    int columns = 0;
    for (long long i = 0; i < all_.count * all_.count; ++i) {
      columns += counts({all_.x + i % all_.count, all_.y + i / all_.count, 1}) ? 1 : 0;
    }
    return columns == 0 ? 0.0 : static_cast<double>(occupied(all_, is_occupied)) / columns;
  }

 private:
  /// A square block of columns; `count` along each edge is a power of two.
  struct Square {
    long long x;
    long long y;
    long long count;
  };

  [[nodiscard]] long long first(double x) const {
    return static_cast<long long>(std::floor((x - radius_m_) / column_m));
  }
  [[nodiscard]] Vec3 low(const Square& square) const {
    return {static_cast<double>(square.x) * column_m, static_cast<double>(square.y) * column_m,
            p_W_.z() - half_band_m_};
  }
  [[nodiscard]] bool counts(const Square& column) const {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * column_m);
    return (low(column).head<2>() + half - p_W_.head<2>()).norm() <= radius_m_;
  }

  /// A square without obstacle is done with one question.
  template <class IsOccupied>
  [[nodiscard]] int occupied(const Square& square, IsOccupied& is_occupied) const {
    constexpr double hair_m = 1e-3;  // a cell that only grazes a column does not fill it
    const double edge_m = static_cast<double>(square.count) * column_m;
    const Vec3 hair{hair_m, hair_m, 0.0};
    const Vec3 corner = low(square);
    const Vec3 size{edge_m, edge_m, 2.0 * half_band_m_};
    if (!is_occupied(Aabb{corner + hair, corner + size - hair})) {
      return 0;
    }
    if (square.count == 1) {
      return counts(square) ? 1 : 0;
    }
    const long long half = square.count / 2;
    int sum = 0;
    for (int i = 0; i < 4; ++i) {
      sum += occupied({square.x + (i % 2) * half, square.y + (i / 2) * half, half}, is_occupied);
    }
    return sum;
  }

  Vec3 p_W_;
  double radius_m_;
  double half_band_m_;
  Square all_{};
};

}  // namespace flyball
