// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The true world from above as cells: where a body fits, and the cheapest path between two places.

#include "flyball/sim/airframe.h"
#include "flyball/sim/world.h"

#include <functional>
#include <optional>
#include <vector>

namespace flyball {

/// A cheapest path; both are under-estimates.
struct CheapestPath {
  double cost{};
  double length_m{};
};

/// What a metre costs.
struct PathPrice {
  /// Anywhere in a cell, from the ground to the ceiling; an under-estimate, and at least `least`.
  std::function<double(const Aabb&)> in_cell{};
  double least{};  ///< Positive.
};

class PathCells {
 public:
  PathCells(const World& world, const Cylinder& body);

  /// Of all paths over open cells the one with the least integral of the price over its length;
  /// empty when there is none. A cell is open if the body fits somewhere in it, at some height
  /// inside the world's bounds; wrong only in calling too many open.
  /// @cost O(n log n) in the cells that a path could lead over. @threads One at a time: it
  /// remembers
  ///       which cells are open.
  [[nodiscard]] std::optional<CheapestPath> path(const Vec3& from_W,
                                                 const Vec3& to_W,
                                                 const PathPrice& price) const;

 private:
  friend class PathSearch;
  enum class Openness : char { not_asked, open, shut };
  [[nodiscard]] bool is_open(int cell) const;
  [[nodiscard]] bool fits_at(const Vec3& centre_W) const;
  [[nodiscard]] Aabb extent_W(int cell) const;
  [[nodiscard]] int cell_at(const Vec3& p_W) const;

  Clearance truth_;
  Aabb bounds_W_;
  Cylinder body_;
  int columns_{};
  int rows_{};
  mutable std::vector<Openness> open_{};  ///< What has been asked for: most cells never are.
};

}  // namespace flyball
