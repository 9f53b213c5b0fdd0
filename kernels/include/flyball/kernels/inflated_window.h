// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A box of space in which a body is checked by one bit: the map there, grown by the body's size.

#include "flyball/runtime/geometry.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flyball {

/// Which cells block the body.
enum class Obstruction : std::uint8_t { occupied, occupied_or_unknown };

/// One bit for each finest cell of a box. It is set where the body, with its centre somewhere in
/// that cell, can overlap what obstructs it; so a bit that is not set speaks for the whole cell.
class InflatedWindow {
 public:
  /// Where the bits are. Cell i of an axis, of `cells`, is that of key `first_key + i`, and lies
  /// `(first_key + i) * cell_m` from the world's origin.
  struct Layout {
    double cell_m{1.0};
    std::array<int, 3> first_key{};
    std::array<int, 3> cells{};  ///< Zero: an empty window.
  };

  /// No bit is set.
  void lay_out(const Layout& layout);
  [[nodiscard]] const Layout& layout() const { return layout_; }
  /// Cell (x, y, z) of the window is bit x % 64 of word (z * row_words() + x / 64) * cells[1] + y.
  [[nodiscard]] std::uint64_t* words() { return words_.data(); }
  [[nodiscard]] int row_words() const { return row_words_; }

  /// True outside the window, and where a place is not finite.
  [[nodiscard]] bool blocks(const Vec3& p_WB) const {
    const auto x = offset(p_WB.x(), 0);
    const auto y = offset(p_WB.y(), 1);
    const auto z = offset(p_WB.z(), 2);
    return !is_inside(x, 0) || !is_inside(y, 1) || !is_inside(z, 2) ||
           blocks_cell(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
  }
  /// Looks at every cell that the straight line between the two centres crosses.
  [[nodiscard]] bool blocks(const Vec3& from_W, const Vec3& to_W) const;

 private:
  /// A straight line through the window, and the cell that it is in.
  struct Walk {
    std::array<int, 3> cell{};
    std::array<int, 3> step{};
    std::array<int, 3> left{};  ///< Steps along each axis.
    std::array<double, 3>
        next_t{};  ///< Next border of each axis: 0 at the line's start, 1 at its end.
    std::array<double, 3> delta_t{};
  };
  [[nodiscard]] Walk walk(const Vec3& from_W, const Vec3& to_W) const;

  /// In cells from the window's first; may be far off, or not a number.
  [[nodiscard]] double offset(double x_m, std::size_t axis) const {
    return cells_per_m_ * x_m - layout_.first_key[axis];
  }
  [[nodiscard]] bool is_inside(double offset, std::size_t axis) const {
    return offset >= 0.0 && offset < layout_.cells[axis];
  }
  [[nodiscard]] bool blocks_cell(int x, int y, int z) const {
    const int word = (z * row_words_ + (x >> 6)) * layout_.cells[1] + y;
    return (words_[static_cast<std::size_t>(word)] >> (x & 63) & 1U) != 0;
  }

  Layout layout_{};
  double cells_per_m_{1.0};
  int row_words_{};
  std::vector<std::uint64_t> words_{};
};

/// A map that can be grown by a body.
class Inflatable {
 public:
  Inflatable() = default;
  Inflatable(const Inflatable&) = delete;
  Inflatable& operator=(const Inflatable&) = delete;
  virtual ~Inflatable() = default;

  /// Fills `window` so that it covers the box, rounded outwards to whole cells. What the map says
  /// later does not change it. A box that does not fit into the map leaves an empty window, which
  /// blocks everywhere.
  ///
  /// @cost In proportion to the box's volume; allocates when `window` has not been so large.
  virtual void inflate(const Aabb& box_W,
                       const Cylinder& body,
                       Obstruction by,
                       InflatedWindow& window) const = 0;
};

}  // namespace flyball
