// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The one lattice of the brick map. Cells have OctoMap's keys: 65536 along each axis, key 32768
/// begins at the world's origin. A cell of level k is 2^k finest cells wide, its key is that of any
/// finest cell in it, shifted right by k. A brick is 4 x 4 x 4 finest cells: a cell of level 2.

#include "flyball/runtime/geometry.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace flyball {

struct CellKey {
  int x{};
  int y{};
  int z{};

  [[nodiscard]] CellKey above(int levels) const { return {x >> levels, y >> levels, z >> levels}; }
  /// The lowest of the cells inside that are so many levels finer. Not a shift: places outside the
  /// lattice have keys below zero.
  [[nodiscard]] CellKey below(int levels) const {
    const int cells = 1 << levels;
    return {x * cells, y * cells, z * cells};
  }
  [[nodiscard]] bool operator==(const CellKey& other) const {
    return x == other.x && y == other.y && z == other.z;
  }
};

inline constexpr int brick_level = 2;
inline constexpr int chunk_level = 5;

/// Bricks of a chunk are numbered in Morton order: bits 0, 3, 6 are x. So the eight bricks of a
/// coarser cell, and the 64 of the next coarser one, are neighbours.
[[nodiscard]] inline std::size_t brick_number(const CellKey& brick) {
  const auto bits = [](int key) {
    const auto offset = static_cast<unsigned>(key);
    return std::size_t{(offset & 1U) | (offset & 2U) << 2U | (offset & 4U) << 4U};
  };
  return bits(brick.x) | bits(brick.y) << 1U | bits(brick.z) << 2U;
}
/// The inverse, for one axis.
[[nodiscard]] inline int brick_offset(std::size_t number, unsigned axis) {
  const std::size_t bits = number >> axis;
  return static_cast<int>((bits & 1U) | (bits >> 2U & 2U) | (bits >> 4U & 4U));
}

/// A chunk's brick by its number.
[[nodiscard]] inline CellKey brick_in(const CellKey& chunk, std::size_t number) {
  constexpr int bricks = 1 << (chunk_level - brick_level);
  return {bricks * chunk.x + brick_offset(number, 0), bricks * chunk.y + brick_offset(number, 1),
          bricks * chunk.z + brick_offset(number, 2)};
}

class Lattice {
 public:
  static constexpr int keys = 1 << 16;
  static constexpr int half_keys = keys / 2;

  explicit Lattice(double finest_m) : finest_m_{finest_m}, cells_per_m_{1.0 / finest_m} {}

  [[nodiscard]] double cell_m(int level) const { return finest_m_ * (1 << level); }
  [[nodiscard]] double cells_per_m() const { return cells_per_m_; }
  [[nodiscard]] double edge_m() const { return half_keys * finest_m_; }
  /// OctoMap's arithmetic: a product, and not a quotient, decides at the borders of cells.
  /// @pre The result fits into an integer.
  [[nodiscard]] int key(double x_m) const {
    const double cells = cells_per_m_ * x_m;
    const int towards_zero = static_cast<int>(cells);  // std::floor is a call before SSE4.1
    return towards_zero - static_cast<int>(cells < static_cast<double>(towards_zero)) + half_keys;
  }
  /// @pre `contains(p)`.
  [[nodiscard]] CellKey cell(const Vec3& p) const { return {key(p.x()), key(p.y()), key(p.z())}; }
  /// False for a place that is not finite.
  [[nodiscard]] bool contains(const Vec3& p) const {
    const double edge = edge_m();
    return (p.array() >= -edge).all() && (p.array() < edge).all();
  }
  /// Where a finest cell begins and ends along an axis.
  [[nodiscard]] std::array<double, 2> side(int key) const {
    return {(key - half_keys) * finest_m_, (key + 1 - half_keys) * finest_m_};
  }
  [[nodiscard]] Aabb cube(const CellKey& cell, int level) const {
    const auto low_m = [&](int key) { return (key * (1 << level) - half_keys) * finest_m_; };
    const auto high_m = [&](int key) { return ((key + 1) * (1 << level) - half_keys) * finest_m_; };
    return {{low_m(cell.x), low_m(cell.y), low_m(cell.z)},
            {high_m(cell.x), high_m(cell.y), high_m(cell.z)}};
  }

 private:
  double finest_m_;
  double cells_per_m_;
};

}  // namespace flyball
