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

 private:
  enum class Mark : std::uint8_t { unknown, known_free, known_solid, reachable };
  [[nodiscard]] Vec3 centre_W(std::size_t cell) const;
  void spread_from(std::size_t cell);

  Vec3 min_W_;
  double cell_m_;
  std::size_t columns_;
  std::size_t rows_;
  std::size_t layers_;
  std::vector<Mark> marks_;
  std::vector<std::size_t> front_;  ///< Cells whose neighbours are still to be looked at.
};

}  // namespace flyball
