// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much of a volume is known, as far as the vehicle itself can tell.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <cstdint>
#include <vector>

namespace flyball {

/// The known share of what can be known. An unknown cell counts only while it may be reached
/// through unknown cells from a cell that is known to be free. Cells that are enclosed by known
/// surfaces (the inside of a wall) no longer count, because no view will ever show them.
class KnownShare {
 public:
  /// @pre `cell_m > 0`. @param volume_W  To be explored.
  KnownShare(const Aabb& volume_W, double cell_m);

  /// 0 to 100; 0 while nothing is known.
  /// @cost One look-up in the map for each cell of the volume.
  [[nodiscard]] double percent(const OccupancyView& map);
  /// Free or occupied, at the last call of `percent`.
  [[nodiscard]] double known_m3() const { return known_m3_; }

 private:
  enum class Mark : std::uint8_t { unknown, known_free, known_solid, reachable };
  [[nodiscard]] Vec3 centre_W(std::size_t cell) const;
  void spread_from(std::size_t cell);

  Vec3 min_W_;
  double cell_m_;
  std::size_t columns_;
  std::size_t rows_;
  std::size_t layers_;
  double known_m3_{};
  std::vector<Mark> marks_;
  std::vector<std::size_t> front_;  ///< Cells whose neighbours are still to be looked at.
};

/// How much of a volume's ground plan is known at the height `z_m`, by the middles of squares.
///
/// @pre `square_m > 0`.
/// @cost One look-up in the map for each square.
[[nodiscard]] double known_area_m2(const OccupancyView& map,
                                   const Aabb& volume_W,
                                   double z_m,
                                   double square_m);

}  // namespace flyball
