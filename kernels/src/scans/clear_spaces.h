// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Cylinders that were declared clear: there, and only where a map knows nothing, space is free.

#include "bricks/lattice.h"
#include "visual/overlap.h"
#include <vector>

namespace flyball {

class ClearSpaces {
 public:
  /// Cylinders that are kept; past it the oldest of the thinnest goes.
  static constexpr std::size_t max_clear = 16;

  struct Space {
    Vec3 centre_W;
    Cylinder space;
  };

  ClearSpaces() { spaces_.reserve(max_clear); }

  /// Ignored when an earlier cylinder contains it.
  void declare(const Vec3& centre_W, const Cylinder& space);
  [[nodiscard]] const std::vector<Space>& all() const { return spaces_; }
  [[nodiscard]] bool is_empty() const { return spaces_.empty(); }
  [[nodiscard]] bool contains(const Vec3& p_W) const;
  /// The cells of a brick that lie in one of the cylinders as a whole.
  [[nodiscard]] std::uint64_t cells_inside(const Lattice& lattice, const CellKey& brick) const;
  /// Whether the cylinders cover the body's share of a box. The box is taken apart, down to pieces
  /// of 19 mm on a lattice of their own, and each piece must lie in one cylinder: its own box, or
  /// the body's disc and the piece's height. A box that is cut on the borders of cells of .15 m
  /// (or of that times a power of two) is covered exactly when its parts are.
  [[nodiscard]] bool cover(const Aabb& part, const BodyShape& body) const;

 private:
  static bool holds_disc(const Space& outer, const Vec3& p_W, double radius_m);
  static bool holds_heights(const Space& outer, double low_m, double high_m);
  static bool holds_rectangle(const Space& outer, const Aabb& box);
  [[nodiscard]] bool one_covers(const Aabb& part, const BodyShape& body) const;

  std::vector<Space> spaces_{};
};

}  // namespace flyball
