// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The true world from above as cells: where a body fits, and the cheapest way between two places.

#include "flyball/sim/airframe.h"
#include "flyball/sim/world.h"

#include <functional>
#include <optional>
#include <vector>

namespace flyball {

/// A cheapest way; both are under-estimates.
struct CheapestWay {
  double cost{};
  double length_m{};
};

class WayCells {
 public:
  /// A cell is open if the body fits somewhere in it, at some height inside the world's bounds;
  /// wrong only in calling too many open.
  WayCells(const World& world, const Cylinder& body);

  /// Of all ways over open cells the one with the least integral of `cost_per_m` over its length;
  /// empty when there is none.
  /// @cost O(n log n) in the cells.
  [[nodiscard]] std::optional<CheapestWay> way(
      const Vec3& from_W,
      const Vec3& to_W,
      const std::function<double(const Vec3&)>& cost_per_m) const;

 private:
  [[nodiscard]] bool is_open(const Clearance& truth, const Vec3& centre_W) const;
  [[nodiscard]] Vec3 centre_W(int cell) const;
  [[nodiscard]] int cell_at(const Vec3& p_W) const;
  [[nodiscard]] std::vector<double> costs(
      const std::function<double(const Vec3&)>& cost_per_m) const;

  Aabb bounds_W_;
  Cylinder body_;
  int columns_{};
  int rows_{};
  std::vector<char> open_{};
};

}  // namespace flyball
