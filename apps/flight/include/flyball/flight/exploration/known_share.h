// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much of a volume is known, as the vehicle itself can tell without having seen all of it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/occupancy.h"

#include <cstdint>
#include <vector>

namespace flyball {

/// The known share of what can be known: unknown space counts as long as it may still be reached
/// through unknown space from a place that is known to be free. What is enclosed by known surfaces
/// (the inside of a wall) counts no more, for no view will ever show it.
class KnownShare {
 public:
  /// @pre `cell_m > 0`. @param volume_W  To be explored.
  KnownShare(const Aabb& volume_W, double cell_m);

  /// 0..100; 0 while nothing is known.
  /// @cost One question to the map for each cell of the volume.
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
